#include "lekalo/jobs/order_report.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "jobs/document/report_document.hpp"
#include "layout_json.hpp"
#include "lekalo/geom/grid.hpp"

namespace lekalo::jobs {
namespace {

void write_figures(io::JsonWriter& json, const OrderFigures& figures) {
  json.fields({{"placed", figures.placed},
               {"missing", figures.missing},
               {"sheets", figures.sheets},
               {"density", figures.density()},
               {"cost", figures.cost}});
}

void write_layout(io::JsonWriter& json, const NestedMaterial& one, const OrderFigures& figures) {
  const layout::Material& material = one.given.material;
  std::optional<std::string_view> name;
  if (!material.name.empty()) name = material.name;
  std::optional<double> thickness;
  if (material.thickness != 0) thickness = geom::mm_from_grid(material.thickness);
  json.begin_object().fields({{"material", name}, {"thickness", thickness}});
  write_figures(json, figures);
  json.field("work", one.nested.work);
  write_unplaced(json, one.nested);
  json.end();
}

}  // namespace

OrderFigures figures_of(const Nested& nested) {
  OrderFigures figures;
  for (const layout::PieceCount& count : nested.completeness.placed) figures.placed += count.total();
  for (const nest::Unplaced& u : nested.unplaced) figures.missing += u.count;
  figures.sheets = nested.completeness.sheets.size();
  for (const layout::SheetUse& use : nested.completeness.sheets) {
    figures.parts_area += use.parts_area;
    figures.material_area += use.material_area;
  }
  figures.cost = nested.completeness.cost;
  return figures;
}

OrderFigures sum_of(const std::vector<OrderFigures>& figures) {
  OrderFigures sum;
  for (const OrderFigures& one : figures) {
    sum.placed += one.placed;
    sum.missing += one.missing;
    sum.sheets += one.sheets;
    sum.parts_area += one.parts_area;
    sum.material_area += one.material_area;
    sum.cost += one.cost;
  }
  return sum;
}

std::string order_json(const std::vector<NestedMaterial>& layouts, const NestOptions& options,
                       double cpu_seconds) {
  Layout all;
  std::vector<OrderFigures> figures;
  std::uint64_t work = 0;
  for (const NestedMaterial& one : layouts) {
    const Layout& given = one.given.layout;
    all.inputs.insert(all.inputs.end(), given.inputs.begin(), given.inputs.end());
    for (const std::string& notice : given.notices)
      if (std::find(all.notices.begin(), all.notices.end(), notice) == all.notices.end())
        all.notices.push_back(notice);
    figures.push_back(figures_of(one.nested));
    work += one.nested.work;
  }
  const OrderFigures sum = sum_of(figures);
  io::JsonWriter json = begin_layout_json("lekalo-order", sum.missing == 0 ? "complete" : "incomplete", all,
                                          options.seed, work);
  json.key("outputs").begin_list();
  for (const NestedMaterial& one : layouts) write_file(json, "nested", {one.written_as, one.nested.bytes});
  json.end().key("layouts").begin_list();
  for (std::size_t i = 0; i < layouts.size(); ++i) write_layout(json, layouts[i], figures[i]);
  json.end();
  write_figures(json, sum);
  json.key("run").object({{"cpu_seconds", cpu_seconds}, {"threads", options.threads}});
  return end_document(json);
}

}  // namespace lekalo::jobs
