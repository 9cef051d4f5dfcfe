#include "lekalo/jobs/bill.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/io/text/excerpt.hpp"

namespace lekalo::jobs {
namespace {

using io::OrderRow;

/// Says whether two rows differ in nothing but quantity and assembly.
bool same_part(const OrderRow& a, const OrderRow& b) {
  return a.file == b.file && a.rotations == b.rotations && a.may_mirror == b.may_mirror &&
         a.grain == b.grain && a.priority == b.priority && a.name == b.name && a.material == b.material &&
         a.purpose == b.purpose;
}

bool says_only_quantity(const OrderRow& row) {
  OrderRow bare;
  bare.file = row.file;
  return same_part(row, bare);
}

struct Assembly {
  std::string name;
  std::vector<std::size_t> rows;     ///< of the bill: what one of it holds
  std::vector<std::size_t> held_by;  ///< rows of the bill that hold it
  std::int64_t wanted = 0;
};

class BillReader {
 public:
  BillReader(const io::OrderTable& bill, const std::string& name, std::string_view prefix)
      : bill_(bill), name_(name), prefix_(prefix) {}

  Result<io::OrderTable> multiplied_out(const std::vector<Build>& builds) {
    find_assemblies();
    LEKALO_CHECK(take(builds));
    LEKALO_TRY(const std::vector<std::size_t> order, from_the_top());
    for (const std::size_t assembly : order) LEKALO_CHECK(hand_down(assemblies_[assembly]));
    return order_of_files();
  }

 private:
  void find_assemblies() {
    for (std::size_t i = 0; i < bill_.rows.size(); ++i) {
      const OrderRow& row = bill_.rows[i];
      const auto [at, is_new] = numbers_.emplace(row.assembly, assemblies_.size());
      if (is_new) assemblies_.push_back({row.assembly, {}, {}, 0});
      assemblies_[at->second].rows.push_back(i);
    }
    held_.resize(bill_.rows.size());
    for (std::size_t i = 0; i < bill_.rows.size(); ++i) {
      const auto held = numbers_.find(bill_.rows[i].file);
      if (held == numbers_.end()) continue;
      held_[i] = held->second;
      assemblies_[held->second].held_by.push_back(i);
    }
    pieces_.resize(bill_.rows.size());
  }

  [[nodiscard]] std::size_t holder(std::size_t row) const {
    return numbers_.find(bill_.rows[row].assembly)->second;
  }

  /// Returns the names of assemblies, as many as a sentence takes.
  template <class Wanted>
  [[nodiscard]] std::string names(const Wanted& wanted) const {
    constexpr std::size_t kMostTold = 10;
    std::string text;
    std::size_t count = 0;
    for (const Assembly& one : assemblies_) {
      if (!wanted(one) || ++count > kMostTold) continue;
      text += (text.empty() ? "" : ", ") + io::excerpt(one.name);
    }
    return text + (count > kMostTold ? " and more" : "");
  }

  Result<void> take(const std::vector<Build>& builds) {
    if (builds.empty()) {
      const std::string tops = names([](const Assembly& one) { return one.held_by.empty(); });
      return failure(
          ErrorCode::usage,
          fmt::format("{} is a bill of materials, with the column assembly; say how many are built, as "
                      "in {}build cabinet=2{}",
                      name_, prefix_, tops.empty() ? "" : "; in no other assembly: " + tops));
    }
    for (const Build& build : builds) {
      const auto found = numbers_.find(build.assembly);
      if (found == numbers_.end())
        return failure(ErrorCode::usage, fmt::format("{}build: {} is no assembly of {}, which has {}",
                                                     prefix_, io::excerpt(build.assembly), name_,
                                                     names([](const Assembly&) { return true; })));
      std::int64_t& wanted = assemblies_[found->second].wanted;
      if (wanted > limits::kMostCount - build.count)
        return failure(ErrorCode::usage, fmt::format("{}build: {} is to be built more than {} times", prefix_,
                                                     io::excerpt(build.assembly), limits::kMostCount));
      wanted += build.count;
    }
    return {};
  }

  /// Returns the assemblies, each behind all that hold it.
  [[nodiscard]] Result<std::vector<std::size_t>> from_the_top() const {
    std::vector<std::size_t> order, holders(assemblies_.size());
    for (std::size_t i = 0; i < assemblies_.size(); ++i) {
      holders[i] = assemblies_[i].held_by.size();
      if (holders[i] == 0) order.push_back(i);
    }
    for (std::size_t next = 0; next < order.size(); ++next)
      for (const std::size_t row : assemblies_[order[next]].rows)
        if (held_[row] && --holders[*held_[row]] == 0) order.push_back(*held_[row]);
    if (order.size() == assemblies_.size()) return order;
    return failure(ErrorCode::bad_input, circle(holders));
  }

  /// Says which assembly is a part of itself.
  /// \param holders  rows that hold an assembly, and are of one that is no part of the order from the top
  [[nodiscard]] std::string circle(const std::vector<std::size_t>& holders) const {
    const auto is_left = [&](std::size_t assembly) { return holders[assembly] > 0; };
    std::size_t at = 0;
    while (!is_left(at)) ++at;
    // Each that is left is held by another that is left, so that the way up comes back to where it was.
    std::vector<std::size_t> way;
    std::vector<std::optional<std::size_t>> visit(assemblies_.size());
    while (!visit[at]) {
      visit[at] = way.size();
      const auto& held_by = assemblies_[at].held_by;
      way.push_back(*std::find_if(held_by.begin(), held_by.end(),
                                  [&](std::size_t row) { return is_left(holder(row)); }));
      at = holder(way.back());
    }
    way.erase(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(*visit[at]));
    std::rotate(way.begin(), std::min_element(way.begin(), way.end()), way.end());
    constexpr std::size_t kMostTold = 6;
    std::string steps;
    for (std::size_t i = 0; i < std::min(way.size(), kMostTold); ++i)
      steps += fmt::format("{}{} in {}", i == 0 ? "" : ", ", io::excerpt(bill_.rows[way[i]].file),
                           io::excerpt(bill_.rows[way[i]].assembly));
    if (way.size() > kMostTold) steps += " and so on";
    const OrderRow& first = bill_.rows[way.front()];
    return fmt::format("{}: {} is a part of itself ({}); take one of these lines out", first.said_in,
                       io::excerpt(first.file), steps);
  }

  /// Gives what is wanted of an assembly to what it holds.
  Result<void> hand_down(const Assembly& assembly) {
    if (assembly.wanted == 0) return {};
    for (const std::size_t i : assembly.rows) {
      const OrderRow& row = bill_.rows[i];
      std::int64_t& sum = held_[i] ? assemblies_[*held_[i]].wanted : pieces_[first_like(i)];
      if (assembly.wanted > limits::kMostCount / row.quantity ||
          sum > limits::kMostCount - assembly.wanted * row.quantity)
        return failure(
            ErrorCode::bad_input,
            fmt::format("{}: {} of {}, with {} of {} each, come to more than {} pieces of it; build fewer",
                        row.said_in, assembly.wanted, io::excerpt(assembly.name), row.quantity,
                        io::excerpt(row.file), limits::kMostCount));
      sum += assembly.wanted * row.quantity;
      if (held_[i] && !says_only_quantity(row) && !more_said_) more_said_ = i;
    }
    return {};
  }

  /// Returns the row that stands for all that order the same part.
  std::size_t first_like(std::size_t row) {
    std::vector<std::size_t>& firsts = firsts_[bill_.rows[row].file];
    const auto found = std::find_if(firsts.begin(), firsts.end(), [&](std::size_t other) {
      return same_part(bill_.rows[other], bill_.rows[row]);
    });
    if (found != firsts.end()) return *found;
    firsts.push_back(row);
    return row;
  }

  [[nodiscard]] io::OrderTable order_of_files() const {
    io::OrderTable order;
    order.notices = bill_.notices;
    if (more_said_)
      order.notices.push_back(
          fmt::format("{}: {} is an assembly, of which the quantity counts; what else is said of "
                      "its parts stands in their own lines",
                      bill_.rows[*more_said_].said_in, io::excerpt(bill_.rows[*more_said_].file)));
    for (std::size_t i = 0; i < bill_.rows.size(); ++i) {
      if (pieces_[i] == 0) continue;
      order.rows.push_back(bill_.rows[i]);
      order.rows.back().quantity = pieces_[i];
    }
    return order;
  }

  const io::OrderTable& bill_;
  const std::string& name_;
  std::string_view prefix_;
  std::vector<Assembly> assemblies_;
  std::map<std::string, std::size_t> numbers_;    ///< of assemblies by their names
  std::vector<std::optional<std::size_t>> held_;  ///< by row: the assembly that it names in place of a file
  std::map<std::string, std::vector<std::size_t>> firsts_;  ///< rows that stand for others, by their files
  std::vector<std::int64_t> pieces_;                        ///< by row; 0 where another row stands for it
  std::optional<std::size_t> more_said_;                    ///< the first row of an assembly that says more
};

}  // namespace

Result<io::OrderTable> ordered_rows(io::OrderTable table, const std::string& name,
                                    const std::vector<Build>& builds, std::string_view prefix) {
  if (table.is_bill) return BillReader(table, name, prefix).multiplied_out(builds);
  if (builds.empty()) return table;
  return failure(
      ErrorCode::usage,
      fmt::format("{}build: {} is no bill of materials, which has the column assembly", prefix, name));
}

}  // namespace lekalo::jobs
