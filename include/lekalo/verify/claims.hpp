#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/simulate.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::verify {

/// The files that lekalo writes besides placements (verify/verify.hpp) are told apart by their bytes, and
/// held against what they were made from. docs/formats.md says of each field whether it is a claim.

enum class Kind : std::uint8_t {
  placement,
  layout,
  placements,  ///< of a strip, in the form of another nesting program
  nest_report,
  order_report,
  check_report,
  show_report,
  pocket_report,
  simulate_report,
  fit_report,
  heat_report,
  quote_report,
  verify_report,
  stock_book,
  certificate,
  program,
  dxf,
  svg,
  hpgl,
  picture,  ///< made to be looked at: PNG, PDF, SVG without layers, HTML
  unknown
};

/// Tells what a file is by its first bytes, and JSON by its field `format`. A file that is said to be of a
/// kind may still be refused by its reader. bad_input, with the line, for what begins as JSON and is none.
/// Cost: O(bytes) for JSON and SVG, else O(1).
[[nodiscard]] Result<Kind> kind_of(const Document& document);

/// Returns the kind in words, "a layout"; for sentences.
[[nodiscard]] std::string_view name_of(Kind kind) noexcept;

struct ClaimReport {
  /// A sentence for everything that is not true.
  std::vector<std::string> findings;
  /// The claims that were not rechecked: a field's name, then why not.
  std::vector<std::string> unchecked;
  /// Sentences about what was looked at.
  std::vector<std::string> notes;
  /// True where the regions that the file states were taken for those of its input.
  bool stated_regions = false;
};

/// Rechecks a layout: every rule of docs/design/layout.md. With the layout that it was made from, also that
/// stocks, parts, kits and rules are the same: only placements may have come, moved and gone, and locked ones
/// lie where they lay. Errors are those of verify_layout.
[[nodiscard]] Result<ClaimReport> verify_layout_claims(const Document& layout,
                                                       const std::optional<Document>& given);

/// A file that a report names, among its inputs or its outputs.
struct NamedFile {
  std::string role, path, sha256;
  /// The diameter of the tool of an earlier program, mm; 0 for other roles.
  double tool_mm = 0;
};

/// Returns the files that a report names, inputs before outputs, in its order. bad_input for what is no
/// report.
[[nodiscard]] Result<std::vector<NamedFile>> named_files(const Document& report);

/// Rechecks a report of `lekalo pocket` or `lekalo simulate`: every figure is made anew from the program, the
/// pocket and the programs before, and is the very same. The regions of a pocket are those stated in the
/// report; they are compared with its input where that is region JSON.
///
/// Fails with bad_input for fields that are missing, not known or of a wrong form, and for programs that
/// simulate() refuses. Cost: that of simulate().
/// \param files  the bytes of named_files(), in that order
[[nodiscard]] Result<ClaimReport> verify_cut_report(const Document& report,
                                                    const std::vector<Document>& files);

/// Rechecks a report of `lekalo nest`, of an order of several layouts, or of `lekalo check`. Of nest: every
/// rule and every figure of the layout that was written (density, cost, lengths, parts, kits, what is not
/// placed, that remnants are free), and that its stocks, parts and kits are those of the layout given. Of an
/// order: every rule of each layout that was written, its material, and the figures of each and of all. Of
/// check: that the violations are those that verify_layout finds; their amounts, places and directions are
/// not rechecked. Of show: density, cost and the number of violations.
///
/// Fails with bad_input for fields that are missing, not known or of a wrong form, and for layouts that
/// cannot be read. Cost: that of verify_layout. \param files  the bytes of named_files(), in that order
[[nodiscard]] Result<ClaimReport> verify_layout_report(const Document& report,
                                                       const std::vector<Document>& files);

/// Rechecks a result of `lekalo fit`: the interferences, by a table of limits of its own; what follows from
/// formulas; and by Betti's theorem that the mean growths of parts that do not yield are those of the
/// pressures, which the forces make, to a thousandth. How growths are distributed, stresses, and what has
/// yielded, is computed by finite elements and named as unchecked.
///
/// Fails with bad_input for fields that are missing, not known or of a wrong form. Cost: O(bytes).
/// \param files  the bytes of named_files(), in that order
[[nodiscard]] Result<ClaimReport> verify_fit_report(const Document& report,
                                                    const std::vector<Document>& files);

/// Rechecks a result of `lekalo heat`: the work of the cuts, by following the program and by formulas of the
/// checker's own; that the heat in the workpiece is its share and is all somewhere; that every place of a
/// wall that the program cuts is there, and was cut when it is said; and by these places all errors,
/// intervals and scalings. How far the walls move, temperatures and stresses are computed in voxels and named
/// as unchecked.
///
/// Fails with bad_input for fields that are missing, not known or of a wrong form, and for programs that
/// simulate() refuses. Cost: that of cut_history(), and pieces of the path times places.
/// \param files  the bytes of named_files(), in that order
[[nodiscard]] Result<ClaimReport> verify_heat_report(const Document& report,
                                                     const std::vector<Document>& files);

/// Rechecks a quote: that its sheets, parts, pieces, areas and remnants are those of its layouts, its rates
/// those of its file; every amount from its quantity and its rate, with fractions; what material is charged
/// and how it is shared out; all sums. Lengths and pierces are followed in the programs where these were
/// written. Seconds are estimates of a model of the machine and named as unchecked; their sums hold.
///
/// Fails with bad_input for fields that are missing, not known or of a wrong form. Cost: O(bytes of all), and
/// that of finding a remnant free. \param files  the bytes of named_files(), in that order
[[nodiscard]] Result<ClaimReport> verify_quote_report(const Document& report,
                                                      const std::vector<Document>& files);
/// Rechecks a stock ("lekalo-stock") from its bytes alone: each item is free, or used by one order that says
/// so; each order breaks no rule of its layouts and is cut from items of their outlines; each remnant lies in
/// the item that it is of, keeps the gap from all parts on it, overlaps no other remnant, satisfies the rule,
/// and has the defects, zones, material and share of the cost; and the sums of areas are right. That a sheet
/// was there, and what it cost, nobody can recheck.
///
/// Fails with bad_input for fields that are missing, not known or of a wrong form, and for layouts that
/// cannot be read. Cost: that of verify_layout for each layout, and for each remnant that of its pairs with
/// the parts.
[[nodiscard]] Result<ClaimReport> verify_stock(const Document& stock);

/// Judges a program for a pocket by itself: the tool leaves the pocket nowhere by more than 0.005 mm, meets
/// material in no rapid motion, and leaves no place uncut that it can reach, wider than 0.02 mm. Errors and
/// cost are those of simulate().
[[nodiscard]] Result<ClaimReport> verify_pocket_program(const Document& program, const Document& pocket,
                                                        const SimulateOptions& options,
                                                        const std::vector<EarlierProgram>& earlier);

/// The words of a plot for a knife that can be rechecked.
struct KnifeWords {
  double blade_offset = 0;  ///< mm, from the axis back to the tip; 0: the knife is tangential
  double turn_above = 0;    ///< radians; a tangential knife is lifted at sharper corners
  double tolerance = 0.1;   ///< mm, of the tip from the outlines
};

/// The words of an export besides its form.
struct ExportWords {
  std::string sheet;                  ///< STOCK or STOCK#COPY; empty for all in use
  std::vector<std::string> only;      ///< layers; empty for all
  double chord_tolerance = 0.02;      ///< mm, of HPGL
  std::optional<KnifeWords> knife{};  ///< of HPGL: what the pen of CUT is, if it is no pen
};

/// Holds a DXF, SVG or HPGL export against its layout: on each layer as many outlines as it has, each on one
/// of the layout's and each of the layout's on one of the file's, within 2e-6 mm (HPGL: half a unit, and the
/// chord tolerance on arcs; the tip of a knife within its own tolerance); marks run along grains. Labels are
/// not claims. bad_input for a file with words that lekalo does not write there; usage for a plot without
/// --sheet where several are in use. Cost: O(n log n) for outlines that do not crowd.
[[nodiscard]] Result<ClaimReport> verify_export(const Document& document, const Document& layout,
                                                const ExportWords& words);

/// The words of a profile program that can be rechecked.
struct ProfileWords {
  std::string sheet;           ///< STOCK or STOCK#COPY; empty where one is in use
  double kerf_mm = 0;          ///< above 0
  double tolerance_mm = 0.01;  ///< what the kerf may enter a part by
  words::Control control = words::Control::linuxcnc;
  double pierce_diameter_mm = 0;  ///< of the disc that a pierce burns; 0: nothing is said of it
  double joint_width_mm = 0;      ///< of the joints that hold parts; 0: every contour is cut all round
  bool common_line = false;       ///< parts may share cuts; without joints
};

/// Holds a profile program against its layout: nothing of a cut, its leads among it, comes nearer to a part
/// than half the kerf less the tolerance; every contour of every part on the sheet is followed all round by a
/// closed cut on its waste side, and no cut follows anything else; what is enclosed is cut before what
/// encloses it, be it a contour or kerfs of several that run into each other. Pierces of a stated diameter
/// are clear of parts, and they and their leads of kerfs that are there before. With joints a contour may be
/// cut in stretches, between whose ends exactly a joint stays that no other kerf or pierce enters. With
/// common lines no cut needs to be closed: a cut runs at half the kerf, within the tolerance, beside every
/// place of every contour that it can reach, no cut goes along another for more than 2 kerfs, all parts are
/// free in the end, and of a part that hangs on by less than a quarter of a kerf nothing is cut but what the
/// kerfs that freed it have all but cut; a cut may begin in a kerf. That a contour is
/// followed without a break is looked at every millimetre. Depth, feeds and power are not claims. Modes that
/// the program does not say are unchecked: the control decides them.
///
/// bad_input with the line for words that lekalo does not write into such a program; usage without --sheet
/// where several are in use. Cost: O(length of the cuts in mm) and the square of their number.
[[nodiscard]] Result<ClaimReport> verify_profile(const Document& program, const Document& layout,
                                                 const ProfileWords& words);

}  // namespace lekalo::verify
