#include "lekalo/base/line_font.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace lekalo {
namespace {

// Letters from 0x20 to 0x7e are converted from the file futural.jhf of the Hershey Fonts. Its terms ask for
// these acknowledgements wherever the data goes:
//   - The Hershey Fonts were originally created by Dr. A. V. Hershey while working at the U. S. National
//     Bureau of Standards.
//   - The format of the Font data in this distribution was originally created by James Hurt, Cognition, Inc.,
//     900 Technology Park Drive, Billerica, MA 01821 (mit-eddie!ci-dandelion!hurt)
// They allow any use, and any format but that of the U.S. NTIS.

/// A letter as that format has it: the left and the right side, then points, each a letter for x and one for
/// y, counted from R, with y downwards; a space and R end a stroke. The baseline is at 9.
struct EncodedLetter {
  char32_t code;
  std::string_view pairs;
};
constexpr int kBaseline = 9;

// clang-format off
constexpr std::array kLetters = std::to_array<EncodedLetter>({
    {0x0020, "JZ"},
    {0x0021, "MWRFRT RRYQZR[SZRY"},
    {0x0022, "JZNFNM RVFVM"},
    {0x0023, "H]SBLb RYBRb RLOZO RKUYU"},
    {0x0024, "H\\PBP_ RTBT_ RYIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX"},
    {0x0025, "F^[FI[ RNFPHPJOLMMKMIKIIJGLFNFPGSHVHYG[F RWTUUTWTYV[X[ZZ[X[VYTWT"},
    {0x0026, "E_\\O\\N[MZMYNXPVUTXRZP[L[JZIYHWHUISJRQNRMSKSIRGPFNGMIMKNNPQUXWZY[[[\\Z\\Y"},
    {0x0027, "MWRHQGRFSGSIRKQL"},
    {0x0028, "KYVBTDRGPKOPOTPYR]T`Vb"},
    {0x0029, "KYNBPDRGTKUPUTTYR]P`Nb"},
    {0x002a, "JZRLRX RMOWU RWOMU"},
    {0x002b, "E_RIR[ RIR[R"},
    {0x002c, "NVSWRXQWRVSWSYQ["},
    {0x002d, "E_IR[R"},
    {0x002e, "NVRVQWRXSWRV"},
    {0x002f, "G][BIb"},
    {0x0030, "H\\QFNGLJKOKRLWNZQ[S[VZXWYRYOXJVGSFQF"},
    {0x0031, "H\\NJPISFS["},
    {0x0032, "H\\LKLJMHNGPFTFVGWHXJXLWNUQK[Y["},
    {0x0033, "H\\MFXFRNUNWOXPYSYUXXVZS[P[MZLYKW"},
    {0x0034, "H\\UFKTZT RUFU["},
    {0x0035, "H\\WFMFLOMNPMSMVNXPYSYUXXVZS[P[MZLYKW"},
    {0x0036, "H\\XIWGTFRFOGMJLOLTMXOZR[S[VZXXYUYTXQVOSNRNOOMQLT"},
    {0x0037, "H\\YFO[ RKFYF"},
    {0x0038, "H\\PFMGLILKMMONSOVPXRYTYWXYWZT[P[MZLYKWKTLRNPQOUNWMXKXIWGTFPF"},
    {0x0039, "H\\XMWPURRSQSNRLPKMKLLINGQFRFUGWIXMXRWWUZR[P[MZLX"},
    {0x003a, "NVROQPRQSPRO RRVQWRXSWRV"},
    {0x003b, "NVROQPRQSPRO RSWRXQWRVSWSYQ["},
    {0x003c, "F^ZIJRZ["},
    {0x003d, "E_IO[O RIU[U"},
    {0x003e, "F^JIZRJ["},
    {0x003f, "I[LKLJMHNGPFTFVGWHXJXLWNVORQRT RRYQZR[SZRY"},
    {0x0040, "E`WNVLTKQKOLNMMPMSNUPVSVUUVS RQKOMNPNSOUPV RWKVSVUXVZV\\T]Q]O\\L[JYHWGTFQFNGLHJJILHOHRIUJWLYNZQ[T[WZYYZX RXKWSWUXV"},
    {0x0041, "I[RFJ[ RRFZ[ RMTWT"},
    {0x0042, "G\\KFK[ RKFTFWGXHYJYLXNWOTP RKPTPWQXRYTYWXYWZT[K["},
    {0x0043, "H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZV"},
    {0x0044, "G\\KFK[ RKFRFUGWIXKYNYSXVWXUZR[K["},
    {0x0045, "H[LFL[ RLFYF RLPTP RL[Y["},
    {0x0046, "HZLFL[ RLFYF RLPTP"},
    {0x0047, "H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZVZS RUSZS"},
    {0x0048, "G]KFK[ RYFY[ RKPYP"},
    {0x0049, "NVRFR["},
    {0x004a, "JZVFVVUYTZR[P[NZMYLVLT"},
    {0x004b, "G\\KFK[ RYFKT RPOY["},
    {0x004c, "HYLFL[ RL[X["},
    {0x004d, "F^JFJ[ RJFR[ RZFR[ RZFZ["},
    {0x004e, "G]KFK[ RKFY[ RYFY["},
    {0x004f, "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF"},
    {0x0050, "G\\KFK[ RKFTFWGXHYJYMXOWPTQKQ"},
    {0x0051, "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF RSWY]"},
    {0x0052, "G\\KFK[ RKFTFWGXHYJYLXNWOTPKP RRPY["},
    {0x0053, "H\\YIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX"},
    {0x0054, "JZRFR[ RKFYF"},
    {0x0055, "G]KFKULXNZQ[S[VZXXYUYF"},
    {0x0056, "I[JFR[ RZFR["},
    {0x0057, "F^HFM[ RRFM[ RRFW[ R\\FW["},
    {0x0058, "H\\KFY[ RYFK["},
    {0x0059, "I[JFRPR[ RZFRP"},
    {0x005a, "H\\YFK[ RKFYF RK[Y["},
    {0x005b, "KYOBOb RPBPb ROBVB RObVb"},
    {0x005c, "KYKFY^"},
    {0x005d, "KYTBTb RUBUb RNBUB RNbUb"},
    {0x005e, "JZRDJR RRDZR"},
    {0x005f, "I[Ib[b"},
    {0x0060, "NVSKQMQORPSORNQO"},
    {0x0061, "I\\XMX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0062, "H[LFL[ RLPNNPMSMUNWPXSXUWXUZS[P[NZLX"},
    {0x0063, "I[XPVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0064, "I\\XFX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0065, "I[LSXSXQWOVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0066, "MYWFUFSGRJR[ ROMVM"},
    {0x0067, "I\\XMX]W`VaTbQbOa RXPVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0068, "I\\MFM[ RMQPNRMUMWNXQX["},
    {0x0069, "NVQFRGSFREQF RRMR["},
    {0x006a, "MWRFSGTFSERF RSMS^RaPbNb"},
    {0x006b, "IZMFM[ RWMMW RQSX["},
    {0x006c, "NVRFR["},
    {0x006d, "CaGMG[ RGQJNLMOMQNRQR[ RRQUNWMZM\\N]Q]["},
    {0x006e, "I\\MMM[ RMQPNRMUMWNXQX["},
    {0x006f, "I\\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM"},
    {0x0070, "H[LMLb RLPNNPMSMUNWPXSXUWXUZS[P[NZLX"},
    {0x0071, "I\\XMXb RXPVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0072, "KXOMO[ ROSPPRNTMWM"},
    {0x0073, "J[XPWNTMQMNNMPNRPSUTWUXWXXWZT[Q[NZMX"},
    {0x0074, "MYRFRWSZU[W[ ROMVM"},
    {0x0075, "I\\MMMWNZP[S[UZXW RXMX["},
    {0x0076, "JZLMR[ RXMR["},
    {0x0077, "G]JMN[ RRMN[ RRMV[ RZMV["},
    {0x0078, "J[MMX[ RXMM["},
    {0x0079, "JZLMR[ RXMR[P_NaLbKb"},
    {0x007a, "J[XMM[ RMMXM RM[X["},
    {0x007b, "KYTBRCQDPFPHQJRKSMSOQQ RRCQEQGRISJTLTNSPORSTTVTXSZR[Q]Q_Ra RQSSUSWRYQZP\\P^Q`RaTb"},
    {0x007c, "NVRBRb"},
    {0x007d, "KYPBRCSDTFTHSJRKQMQOSQ RRCSESGRIQJPLPNQPURQTPVPXQZR[S]S_Ra RSSQUQWRYSZT\\T^S`RaPb"},
    {0x007e, "F^IUISJPLONOPPTSVTXTZS[Q RISJQLPNPPQTTVUXUZT[Q[O"},
    {0x00b0, "LXRFPGOIPKRLTKUITGRF"},
    {0x00b1, "E_RIRW RIP[P RI[[["},
    {0x00b2, "KYNIOGRFUGUJNQVQ"},
    {0x00b3, "KYNFVFRJUKVNTPQQNO"},
    {0x00b5, "H[LMLb RLWMZO[R[TZWW RWMW["},
    {0x00c4, "I[RFJ[ RRFZ[ RMTWT ROCNBOAPBOC RUCTBUAVBUC"},
    {0x00d6, "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF ROCNBOAPBOC RUCTBUAVBUC"},
    {0x00d7, "G]KKYY RYKKY"},
    {0x00d8, "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF RZEJ\\"},
    {0x00dc, "G]KFKULXNZQ[S[VZXXYUYF ROCNBOAPBOC RUCTBUAVBUC"},
    {0x00df, "I[L[LKMHPFSFVHVKTNQO RQOUPXSXWVZS[P["},
    {0x00e4, "I\\XMX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX ROINHOGPHOI RUITHUGVHUI"},
    {0x00f6, "I\\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM ROINHOGPHOI RUITHUGVHUI"},
    {0x00f8, "I\\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM RYLK\\"},
    {0x00fc, "I\\MMMWNZP[S[UZXW RXMX[ ROINHOGPHOI RUITHUGVHUI"},
    {0x03bc, "H[LMLb RLWMZO[R[TZWW RWMW["},
    {0x0401, "H[LFL[ RLFYF RLPTP RL[Y[ ROCNBOAPBOC RUCTBUAVBUC"},
    {0x0410, "I[RFJ[ RRFZ[ RMTWT"},
    {0x0411, "H\\LFL[ RLFXF RLPTPWQXRYTYWXYWZT[L["},
    {0x0412, "G\\KFK[ RKFTFWGXHYJYLXNWOTP RKPTPWQXRYTYWXYWZT[K["},
    {0x0413, "IZM[MFXF"},
    {0x0414, "H\\J`J[Z[Z` RM[ORPFXFX["},
    {0x0415, "H[LFL[ RLFYF RLPTP RL[Y["},
    {0x0416, "F^RFR[ RIFRP[F RI[RP[["},
    {0x0417, "H\\LINGQFTFWGXIXLWNTPQP RTPWQYTYWWZT[P[MZKW"},
    {0x0418, "G]KFK[YFY["},
    {0x0419, "G]KFK[YFY[ ROAPCRDTCUA"},
    {0x041a, "G\\KFK[ RYFKT RPOY["},
    {0x041b, "H\\J[LZMWOFXFX["},
    {0x041c, "F^JFJ[ RJFR[ RZFR[ RZFZ["},
    {0x041d, "G]KFK[ RYFY[ RKPYP"},
    {0x041e, "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF"},
    {0x041f, "G]K[KFYFY["},
    {0x0420, "G\\KFK[ RKFTFWGXHYJYMXOWPTQKQ"},
    {0x0421, "H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZV"},
    {0x0422, "JZRFR[ RKFYF"},
    {0x0423, "I[KFRT RYFRTPXNZL["},
    {0x0424, "G]RFR[ RPJMKKMJPKSMUPVTVWUYSZPYMWKTJPJ"},
    {0x0425, "H\\KFY[ RYFK["},
    {0x0426, "G]KFK[Z[Z` RXFX["},
    {0x0427, "H\\LFLMMPPRSRXP RXFX["},
    {0x0428, "E_IFI[[[[F RRFR["},
    {0x0429, "E`IFI[][]` RRFR[ R[F[["},
    {0x042a, "G]IFNFN[U[XZZWZTXQUPNP"},
    {0x042b, "F^JFJ[P[SZUWUTSQPPJP RZFZ["},
    {0x042c, "H[LFL[S[VZXWXTVQSPLP"},
    {0x042d, "H]KKLINGPFTFVGXIYKZNZSYVXXVZT[P[NZLXKV RRPZP"},
    {0x042e, "D_HFH[ RHPMP RSFPGNJMNMSNWPZS[V[YZ[W\\S\\N[JYGVFSF"},
    {0x042f, "H\\XFX[ RXFPFMGLHKJKLLNMOPPXP RQPK["},
    {0x0430, "I\\XMX[ RXPVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0431, "I[WEUFQGNIMMMUNYQ[S[VYWVWSVPSNQNNPMS"},
    {0x0432, "IZLML[ RLMTMVNWNXPXQWRVSTT RLTTTVTWUXVXXWZVZT[L["},
    {0x0433, "KXN[NMWM"},
    {0x0434, "JZL_L[X[X_ RN[PUPMWMW["},
    {0x0435, "I[LSXSXQWOVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0436, "H\\RMR[ RKMRTYM RK[RTY["},
    {0x0437, "JZMOONQMTMVNWOWQVRTTQT RTTVTXVXXVZT[P[NZLX"},
    {0x0438, "I[LML[XMX["},
    {0x0439, "I[LML[XMX[ RPJPKRLTKTJ"},
    {0x043a, "IZLML[ RXMLV RPSX["},
    {0x043b, "JZL[MZNXPMWMW["},
    {0x043c, "H\\LML[ RLMR[ RXMR[ RXMX["},
    {0x043d, "I[LML[ RXMX[ RLTXT"},
    {0x043e, "I\\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM"},
    {0x043f, "I[L[LMXMX["},
    {0x0440, "H[LMLb RLPNNPMSMUNWPXSXUWXUZS[P[NZLX"},
    {0x0441, "I[XPVNTMQMONMPLSLUMXOZQ[T[VZXX"},
    {0x0442, "LXRMR[ RLMXM"},
    {0x0443, "JZLMR[ RXMR[P_NaLbKb"},
    {0x0444, "G]RFRb RPMMNKPJTKXMZP[T[WZYXZTYPWNTMPM"},
    {0x0445, "J[MMX[ RXMM["},
    {0x0446, "I[LML[X[X_ RWMW["},
    {0x0447, "JZMMMRNTPUSUWT RWMW["},
    {0x0448, "H\\KMK[Y[YM RRMR["},
    {0x0449, "H]KMK[[[[_ RRMR[ RYMY["},
    {0x044a, "I[KMOMO[T[WZXXXVWTTTOT"},
    {0x044b, "H\\LML[P[SZTXTVSTPTLT RXMX["},
    {0x044c, "JYMMM[S[UZWXWVUTSTMT"},
    {0x044d, "J[LPMOONPMTMUNWOXPXRXVXXWYUZT[P[OZMYLX RRTXT"},
    {0x044e, "G\\JMJ[ RJTNT RSMPNOPNRNVOXPZS[U[XZYXZVZRYPXNUMSM"},
    {0x044f, "JZWMW[ RWMPMNNMNLPLQMRNSPTWT RQTL["},
    {0x0451, "I[LSXSXQWOVNTMQMONMPLSLUMXOZQ[T[VZXX ROINHOGPHOI RUITHUGVHUI"},
    {0x2013, "G]JRZR"},
    {0x2014, "CaFR^R"},
    {0x2116, "CaF[FFR[RF RZKWLVOWRZS]R^O]LZK RVW^W"},
    {0x2300, "G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF RZEJ\\"},
});
// clang-format on

constexpr int number_of(char c) { return c - 'R'; }

}  // namespace

std::optional<LineLetter> line_letter(char32_t code) {
  const auto* const found =
      std::lower_bound(kLetters.begin(), kLetters.end(), code,
                       [](const EncodedLetter& letter, char32_t wanted) { return letter.code < wanted; });
  if (found == kLetters.end() || found->code != code) return std::nullopt;
  const std::string_view pairs = found->pairs;
  const int left = number_of(pairs[0]);
  LineLetter letter{number_of(pairs[1]) - left, {}};
  bool is_open = false;
  for (std::size_t i = 2; i + 1 < pairs.size(); i += 2) {
    if (pairs[i] == ' ') {
      is_open = false;
      continue;
    }
    if (!is_open) letter.strokes.emplace_back();
    is_open = true;
    letter.strokes.back().emplace_back(number_of(pairs[i]) - left, kBaseline - number_of(pairs[i + 1]));
  }
  return letter;
}

char32_t take_code_point(std::string_view& text) noexcept {
  constexpr char32_t kNone = 0xfffd;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t size = first < 0x80                    ? 1
                           : first >= 0xc2 && first < 0xe0 ? 2
                           : first >= 0xe0 && first < 0xf0 ? 3
                           : first >= 0xf0 && first < 0xf5 ? 4
                                                           : 0;
  if (size == 0 || size > text.size()) {
    text.remove_prefix(1);
    return kNone;
  }
  char32_t code = size == 1 ? first : first & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) {
      text.remove_prefix(1);
      return kNone;
    }
    code = (code << 6U) | (byte(i) & 0x3fU);
  }
  text.remove_prefix(size);
  return code;
}

}  // namespace lekalo
