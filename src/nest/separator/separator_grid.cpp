#include <algorithm>
#include <cmath>

#include "nest/tuning/tuning.hpp"
#include "separator.hpp"

namespace lekalo::nest {

bool Separator::make_grid(double pitch) {
  grid_.reset();
  sums_.reset();
  fixed_costs_.clear();
  double nodes = 0;
  for (const Bin& bin : problem_.bins())
    nodes += (bin.box.x1 - bin.box.x0) * (bin.box.y1 - bin.box.y0) / (pitch * pitch);
  const bool merged =
      !items_.fixed.empty() && nodes * static_cast<double>(problem_.forms().size()) <= tuning::kMostMerged;
  if (!CostGrid::pays(problem_, pitch, merged)) return false;
  if (merged) fixed_costs_.resize(problem_.bins().size() * problem_.forms().size());
  std::vector<double> root_of_form(problem_.forms().size(), 1);
  for (std::size_t i = 0; i < items_.movable(); ++i)
    for (std::uint32_t f = items_.forms[i].first; f < items_.forms[i].last; ++f) root_of_form[f] = root_[i];
  const Form* first = problem_.forms().data();
  grid_.emplace(
      problem_, pitch,
      [this, first, roots = std::move(root_of_form)](const Form& a, const Form& b, double dx, double dy) {
        const double depth = problem_.depth(a, b, dx, dy);
        if (depth <= kTolerance) return 0.0f;
        return static_cast<float>(cost_of(depth, problem_.common_area(a, b, dx, dy)) *
                                  roots[static_cast<std::size_t>(&a - first)] *
                                  roots[static_cast<std::size_t>(&b - first)]);
      });
  if (sums_pay()) sums_.emplace(problem_.bins().size(), problem_.forms().size());
  return true;
}

/// True if kept sums are quicker. With them a move changes two rasters in the sums of every form; without
/// them it adds up everything that lies there, in the forms it looks at.
bool Separator::sums_pay() const {
  const std::size_t forms = problem_.forms().size();
  double looked_at = 0;
  for (const Forms& f : items_.forms) looked_at += std::min(f.last - f.first, tuning::kFormsOnGrid);
  looked_at /= static_cast<double>(items_.movable());
  if (2.0 * static_cast<double>(forms) > looked_at * static_cast<double>(total_)) return false;
  double nodes = 0;
  for (const Bin& bin : problem_.bins())
    nodes += std::min<double>(tuning::kMostKept, (bin.box.x1 - bin.box.x0) * (bin.box.y1 - bin.box.y0) /
                                                     (grid_->pitch() * grid_->pitch()));
  return nodes * static_cast<double>(forms) <= tuning::kMostKeptInAll;
}

bool Separator::use_lattice(double unit) {
  lattice_ = 0;
  if (unit > 0 && make_grid(unit)) {
    lattice_ = unit;
    return true;
  }
  if (!make_grid(tuning::kPitch * unit_)) make_grid(tuning::kCoarsePitch * unit_);
  return unit == 0;
}

void Separator::to_lattice() {
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    Spot spot = state_.spots[i];
    if (spot.bin == kNowhere) continue;
    const Range r = range_of(spot.form, spot.bin, items_.parts[i]);
    spot.x = r.x0 + std::round((spot.x - r.x0) / lattice_) * lattice_;
    spot.y = r.y0 + std::round((spot.y - r.y0) / lattice_) * lattice_;
    while (spot.x > r.x1 + 1e-6 && spot.x > r.x0) spot.x -= lattice_;
    while (spot.y > r.y1 + 1e-6 && spot.y > r.y0) spot.y -= lattice_;
    set_spot(i, spot);
  }
}

/// The costs of a form with all obstacles of a bin, everywhere there; null where each obstacle has rasters.
const NodeGrid* Separator::fixed_costs(std::uint32_t form, std::uint32_t bin) {
  const Bin& on = problem_.bins()[bin];
  if (fixed_costs_.empty() || on.obstacles.empty()) return nullptr;
  std::optional<NodeGrid>& made = fixed_costs_[bin * problem_.forms().size() + form];
  if (!made) {
    const Box& b = problem_.forms()[form].box;
    const double gap = problem_.border_gap_of(problem_.part_of(problem_.forms()[form]));
    made.emplace();
    made->begin(on.box.x0 + gap - b.x0, on.box.y0 + gap - b.y0,
                grid_->nodes(on.box.x1 - on.box.x0 - 2 * gap - (b.x1 - b.x0)) + 1,
                grid_->nodes(on.box.y1 - on.box.y0 - 2 * gap - (b.y1 - b.y0)) + 1);
    grid_->add_obstacles(*made, on.obstacles, form);
  }
  return &*made;
}

/// The heaviest weight that item i has for an obstacle of the bin.
float Separator::heaviest_obstacle(std::size_t i, std::uint32_t bin) const {
  float most = 1;
  for (std::size_t j = items_.movable(); j < total_; ++j)
    if (state_.spots[j].bin == bin) most = std::max(most, weights_[i * total_ + j]);
  return most;
}

/// Fills the nodes with what item i would cost in a form everywhere in the range, or in a window of it
/// where the range is large (nest.md, step 3).
void Separator::fill_grid(std::size_t i, std::uint32_t form, std::uint32_t bin, const Range& range) {
  std::uint32_t columns = grid_->nodes(range.x1 - range.x0), rows = grid_->nodes(range.y1 - range.y0);
  const std::uint64_t before = grid_->added();
  const NodeGrid* fixed = fixed_costs(form, bin);
  const std::size_t rastered = fixed_costs_.empty() ? total_ : items_.movable();
  if (sums_ && std::uint64_t{columns} * rows <= tuning::kMostKept) {
    nodes_ = sums_->now(*grid_, form, bin, range.x0, range.y0, columns, rows,
                        std::span(state_.spots).first(rastered), fixed);
    add_raised(i, form, bin);
    if (const float most = heaviest_obstacle(i, bin); fixed != nullptr && most > 1)
      nodes_.add(*fixed, 0, 0, most - 1);
  } else {
    double x0 = range.x0, y0 = range.y0;
    const auto cut = [&](double& from, std::uint32_t& count, std::uint32_t most) {
      if (count <= most) return std::uint32_t{0};
      const auto skipped = static_cast<std::uint32_t>(random_.below(count - most + 1));
      from += static_cast<double>(skipped) * grid_->pitch();
      count = most;
      return skipped;
    };
    const std::uint32_t row = cut(y0, rows, tuning::kMostRows);
    const std::uint32_t column = cut(x0, columns, tuning::kMostWindow / rows);
    nodes_.begin(x0, y0, columns, rows);
    const Form& f = problem_.forms()[form];
    const double pitch = grid_->pitch();
    gather({x0 + f.box.x0, y0 + f.box.y0, x0 + columns * pitch + f.box.x1, y0 + rows * pitch + f.box.y1}, bin,
           i);
    const float* weights = &weights_[i * total_];
    if (fixed != nullptr) nodes_.add(*fixed, column, row, heaviest_obstacle(i, bin));
    for (const std::uint32_t j : near_)
      if (j < rastered)
        grid_->add(nodes_, state_.spots[j].form, form, state_.spots[j].x, state_.spots[j].y, weights[j]);
  }
  work_ += (grid_->added() - before + std::uint64_t{columns} * rows) / tuning::kNodesAsPlace;
}

/// Corrects the sums of everything on a bin for item i: adds its raised weights, and takes away the item
/// itself.
void Separator::add_raised(std::size_t i, std::uint32_t form, std::uint32_t bin) {
  const float* weights = &weights_[i * total_];
  const std::size_t rastered = fixed_costs_.empty() ? total_ : items_.movable();
  for (std::size_t j = 0; j < rastered; ++j) {
    const Spot& s = state_.spots[j];
    const float weight = j == i ? 0.0f : weights[j];
    if (s.bin == bin && weight != 1) grid_->add(nodes_, s.form, form, s.x, s.y, weight - 1);
  }
}

void Separator::move_on_lattice(std::size_t i) {
  const Forms& forms = items_.forms[i];
  const std::uint32_t bin = any_bin();
  const double pitch = grid_->pitch();
  Spot best = state_.spots[i];
  float least = std::numeric_limits<float>::infinity();
  std::uint64_t ties = 0;
  for (std::uint32_t form = forms.first; form < forms.last; ++form) {
    const Range r = range_of(form, bin, items_.parts[i]);
    if (r.is_empty()) continue;
    fill_grid(i, form, bin, r);
    for (std::uint32_t row = 0; row < nodes_.rows; ++row) {
      const float* values = nodes_.row(row);
      for (std::uint32_t c = 0; c < nodes_.columns; ++c) {
        if (values[c] > least) continue;
        if (values[c] < least) {
          least = values[c];
          ties = 0;
        }
        if (random_.below(++ties) == 0) best = {nodes_.x0 + c * pitch, nodes_.y0 + row * pitch, form, bin};
      }
    }
  }
  if (ties > 0) set_spot(i, best);
}

/// Offers the deepest hollows of the cost over a bin, in all forms of item i or in some of many.
void Separator::choose_on_grid(std::size_t i, std::uint32_t bin, Choice& choice) {
  const Forms& forms = items_.forms[i];
  const std::uint32_t count = forms.last - forms.first, tried = std::min(count, tuning::kFormsOnGrid);
  const double pitch = grid_->pitch();
  Choice rough;
  for (std::uint32_t k = 0; k < tried; ++k) {
    const std::uint32_t form =
        forms.first + (tried == count ? k : static_cast<std::uint32_t>(random_.below(count)));
    const Range r = range_of(form, bin, items_.parts[i]);
    if (r.is_empty()) continue;
    fill_grid(i, form, bin, r);
    const std::uint32_t columns = nodes_.columns, rows = nodes_.rows;
    for (std::uint32_t row = 0; row < rows; ++row) {
      const float* at = nodes_.row(row);
      const float* below = row > 0 ? nodes_.row(row - 1) : at;
      const float* above = row + 1 < rows ? nodes_.row(row + 1) : at;
      float worst = static_cast<float>(rough.worst());
      for (std::uint32_t block = nodes_.block_below(row, 0, worst); block * CostGrid::kBlock < columns;
           block = nodes_.block_below(row, block + 1, worst)) {
        for (std::uint32_t c = block * CostGrid::kBlock;
             c < std::min(columns, (block + 1) * CostGrid::kBlock); ++c) {
          const float v = at[c];
          if (v >= worst || v > below[c] || v > above[c] || (c > 0 && v > at[c - 1]) ||
              (c + 1 < columns && v > at[c + 1]))
            continue;
          const Spot spot = {std::min(r.x1, nodes_.x0 + c * pitch), std::min(r.y1, nodes_.y0 + row * pitch),
                             form, bin};
          rough.offer({spot, static_cast<double>(v)});
          worst = static_cast<float>(rough.worst());
        }
      }
    }
  }
  for (std::size_t k = 0; k < rough.count; ++k)
    choice.offer({rough.places[k].spot,
                  evaluate_all(i, rough.places[k].spot, std::numeric_limits<double>::infinity())});
}

}  // namespace lekalo::nest
