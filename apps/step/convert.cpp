#include "convert.hpp"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPConstruct.hxx>
#include <STEPConstruct_Styles.hxx>
#include <STEPControl_Reader.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepVisual_Colour.hxx>
#include <StepVisual_ColourRgb.hxx>
#include <StepVisual_DraughtingPreDefinedColour.hxx>
#include <StepVisual_PreDefinedItem.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "lekalo/base/counted.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/io/solid/solid_file.hpp"

namespace lekalo::step {
namespace {

tl::unexpected<Error> refuse(const std::string& sentence) { return failure(ErrorCode::bad_input, sentence); }

/// The name of a face in its STEP file, in the letters that a comment of a PLY can have.
std::string name_of(const STEPControl_Reader& reader, const TopoDS_Shape& face) {
  const auto entity = reader.WS()->TransferReader()->EntityFromShapeResult(face, 1);
  const auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity);
  if (item.IsNull() || item->Name().IsNull()) return {};
  std::string name = item->Name()->ToCString();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  constexpr std::size_t kLongest = 200;
  return name.substr(0, kLongest);
}

/// The colours that the file gives to faces, and to shells and solids, whose faces then have them.
class Colours {
 public:
  explicit Colours(const STEPControl_Reader& reader) {
    STEPConstruct_Styles styles(reader.WS());
    if (!styles.LoadStyles()) return;
    const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
    for (Standard_Integer k = 1; k <= styles.NbStyles(); ++k) {
      const Handle(StepVisual_StyledItem) style = styles.Style(k);
      Handle(StepVisual_Colour) surface, border, curve, rendered;
      Standard_Real transparency = 0;
      Standard_Boolean is_component = Standard_False;
      if (style.IsNull() || style->Item().IsNull() ||
          !styles.GetColors(style, surface, border, curve, rendered, transparency, is_component))
        continue;
      const std::optional<std::uint32_t> number = number_of(surface.IsNull() ? rendered : surface);
      const TopoDS_Shape shape = STEPConstruct::FindShape(process, style->Item());
      if (number && !shape.IsNull()) of_.Bind(in_place(shape), static_cast<Standard_Integer>(*number));
    }
  }

  /// The colour of the first that has one.
  [[nodiscard]] std::uint32_t of(std::initializer_list<TopoDS_Shape> shapes) const {
    for (const TopoDS_Shape& shape : shapes)
      if (const Standard_Integer* const found = of_.Seek(in_place(shape)))
        return static_cast<std::uint32_t>(*found);
    return io::SolidFile::kNoColour;
  }

 private:
  /// The parts of an assembly are one shape at several places.
  static TopoDS_Shape in_place(const TopoDS_Shape& shape) { return shape.Located(TopLoc_Location()); }

  /// The numbers of the file, without what OCCT makes of them for screens.
  static std::optional<std::uint32_t> number_of(const Handle(StepVisual_Colour) & colour) {
    std::array<double, 3> parts{};
    if (const auto rgb = Handle(StepVisual_ColourRgb)::DownCast(colour); !rgb.IsNull()) {
      parts = {rgb->Red(), rgb->Green(), rgb->Blue()};
    } else if (const auto known = Handle(StepVisual_DraughtingPreDefinedColour)::DownCast(colour);
               !known.IsNull() && !known->GetPreDefinedItem().IsNull() &&
               !known->GetPreDefinedItem()->Name().IsNull()) {
      constexpr std::array<std::pair<std::string_view, unsigned>, 8> kNamed{{{"black", 0},
                                                                             {"blue", 1},
                                                                             {"green", 2},
                                                                             {"cyan", 3},
                                                                             {"red", 4},
                                                                             {"magenta", 5},
                                                                             {"yellow", 6},
                                                                             {"white", 7}}};
      const std::string name = known->GetPreDefinedItem()->Name()->ToCString();
      const auto at =
          std::find_if(kNamed.begin(), kNamed.end(), [&](const auto& one) { return one.first == name; });
      if (at == kNamed.end()) return std::nullopt;
      for (std::size_t k = 0; k < 3; ++k) parts[k] = at->second >> (2 - k) & 1;
    } else {
      return std::nullopt;
    }
    std::uint32_t number = 0;
    for (const double part : parts) {
      if (!(part >= 0 && part <= 1)) return std::nullopt;
      number = 256 * number + static_cast<std::uint32_t>(std::lround(255 * part));
    }
    return number;
  }

  TopTools_DataMapOfShapeInteger of_;
};

/// Triangulates all faces anew, no coarser than the deflection as OCCT understands it.
void triangulate(const TopoDS_Shape& shape, double deflection) {
  BRepTools::Clean(shape);
  IMeshTools_Parameters how;
  how.Deflection = deflection;
  how.Angle = 0.5;
  how.MinSize = deflection / 10;
  how.AllowQualityDecrease = true;
  const BRepMesh_IncrementalMesh done(shape, how);
}

/// Coordinates and what is computed from them are rounded; this is far above it.
double rounding(const solid::Mesh& mesh) {
  double largest = 0;
  for (const solid::Vector p : mesh.vertices)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return 0x1p-36 * largest;
}

std::string place_of(std::size_t face, const FaceRecord& record) {
  return record.name.empty() ? fmt::format("face {}", face) : fmt::format("face {} ({})", face, record.name);
}

/// The triangles that OCCT has made, divided where they are not fine enough, with their bounds.
Result<Converted> refined(const TopoDS_Shape& shape, const std::vector<FaceRecord>& told, double asked) {
  Converted made;
  BodyMesh body;
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next()) {
    ++made.solids;
    for (TopExp_Explorer face(solid.Current(), TopAbs_FACE); face.More(); face.Next())
      body.add(TopoDS::Face(face.Current()));
  }
  for (std::size_t k = 0; k < told.size(); ++k)
    body.faces()[k].name = told[k].name, body.faces()[k].colour = told[k].colour;
  body.refine(asked - rounding(body.mesh().first), limits::kMostSolidItems);
  if (body.triangle_count() > limits::kMostSolidItems)
    return refuse(
        fmt::format("more than {} triangles; ask for a larger --deviation", limits::kMostSolidItems));
  body.bound();
  made.faces = body.faces();
  for (std::size_t k = 0; k < made.faces.size(); ++k) {
    const FaceRecord& record = made.faces[k];
    if (!record.fault.empty())
      return refuse(
          fmt::format("{}: {}, so that nothing is proved of its triangles; export a mesh (STL, "
                      "PLY, OBJ) instead",
                      place_of(k, record), record.fault));
    made.deviation = std::max(made.deviation, record.deviation);
  }
  std::tie(made.mesh, made.face_of_triangle) = body.mesh();
  made.deviation += rounding(made.mesh);
  return made;
}

}  // namespace

Result<Converted> convert(const std::string& path, double deviation) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  STEPControl_Reader reader;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    return refuse("this is no STEP file that can be read");
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.NbShapes() > 0 ? reader.OneShape() : TopoDS_Shape();
  const Colours colours(reader);
  std::vector<FaceRecord> told;
  std::size_t solids = 0;
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); !shape.IsNull() && solid.More(); solid.Next()) {
    ++solids;
    for (TopExp_Explorer shell(solid.Current(), TopAbs_SHELL); shell.More(); shell.Next())
      for (TopExp_Explorer face(shell.Current(), TopAbs_FACE); face.More(); face.Next()) {
        FaceRecord& record = told.emplace_back();
        record.name = name_of(reader, face.Current());
        record.colour = colours.of({face.Current(), shell.Current(), solid.Current()});
      }
  }
  if (solids == 0)
    return refuse("there is no solid in this STEP file; export the body as a solid, not as surfaces");
  TopTools_IndexedMapOfShape all, within;
  TopExp::MapShapes(shape, TopAbs_FACE, all);
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next())
    TopExp::MapShapes(solid.Current(), TopAbs_FACE, within);

  // OCCT's triangles are only the beginning: it is as fine everywhere as it is anywhere, and slow at it.
  constexpr int kMostRounds = 6;
  constexpr double kCoarse = 4;
  double deflection = kCoarse * deviation;
  Result<Converted> best = refuse("nothing is proved of its triangles");
  for (int round = 0; round < kMostRounds; ++round) {
    triangulate(shape, deflection);
    Result<Converted> made = refined(shape, told, deviation);
    if (!made) return made;
    if (!best || made->deviation < best->deviation) best = std::move(made);
    // A face that its triangles do not follow is followed by finer ones, or by none.
    if (std::isfinite(best->deviation)) break;
    constexpr double kFiner = 0.4;
    deflection *= kFiner;
  }
  if (!best) return best;
  if (!std::isfinite(best->deviation)) {
    const auto face = std::find_if(best->faces.begin(), best->faces.end(),
                                   [](const FaceRecord& f) { return !std::isfinite(f.deviation); });
    return refuse(
        fmt::format("{}: OCCT's triangles of this {} do not follow it, however fine they are; export a mesh "
                    "(STL, PLY, OBJ) instead",
                    place_of(static_cast<std::size_t>(face - best->faces.begin()), *face), face->kind));
  }
  const Result<solid::ClosedMesh> closed = solid::closed_mesh(best->mesh);
  if (!closed) return refuse(closed.error().message);
  best->notices = closed->notices;
  if (solids > 1) best->notices.push_back(fmt::format("the file has {} solids; all are read", solids));
  if (all.Extent() > within.Extent())
    best->notices.push_back(fmt::format("{} no solid and left out",
                                        counted(static_cast<std::size_t>(all.Extent() - within.Extent()),
                                                "face belongs to", "faces belong to")));
  return best;
}

std::string written(const Converted& converted, std::string_view name, std::string_view sha256) {
  // Not below the deviation, with six digits.
  const auto rounded = [](double millimetres) {
    return fmt::format("{:.6e}", millimetres * (1 + 1e-6) + std::numeric_limits<double>::min());
  };
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment lekalo-step 1\ncomment units mm\ncomment deviation "
      "{}\ncomment "
      "source {} {}\n",
      rounded(converted.deviation), sha256, name);
  text += fmt::format(
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty "
      "list "
      "uchar uint vertex_indices\nproperty uint face\nelement body_face {}\nproperty double "
      "deviation\nproperty uint colour\nproperty list uchar "
      "uchar kind\nproperty list uchar uchar name\nend_header\n",
      converted.mesh.vertices.size(), converted.mesh.triangles.size(), converted.faces.size());
  const auto put = [&](std::uint64_t bits, int bytes) {
    for (int k = 0; k < bytes; ++k) text += static_cast<char>(bits >> (8 * k) & 0xff);
  };
  for (const solid::Vector p : converted.mesh.vertices)
    for (const double x : {p.x, p.y, p.z}) put(std::bit_cast<std::uint64_t>(x), 8);
  for (std::size_t t = 0; t < converted.mesh.triangles.size(); ++t) {
    put(3, 1);
    for (const std::uint32_t v : converted.mesh.triangles[t]) put(v, 4);
    put(converted.face_of_triangle[t], 4);
  }
  for (const FaceRecord& face : converted.faces) {
    put(std::bit_cast<std::uint64_t>(face.deviation), 8);
    put(face.colour, 4);
    for (const std::string* word : {&face.kind, &face.name}) {
      put(word->size(), 1);
      text += *word;
    }
  }
  return text;
}

}  // namespace lekalo::step
