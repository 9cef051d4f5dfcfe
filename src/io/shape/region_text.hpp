#pragma once

#include "lekalo/geom/region.hpp"
#include "lekalo/io/text/json_writer.hpp"

namespace lekalo::io::detail {

/// An edge of the JSON form of regions. \param open  adds `"open": true`
void write_edge(JsonWriter& json, const geom::Edge& edge, bool open = false);
void write_edges(JsonWriter& json, const geom::Contour& edges);
void write_region(JsonWriter& json, const geom::Region& region);

}  // namespace lekalo::io::detail
