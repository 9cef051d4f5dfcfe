#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/stock.hpp"
#include "store/sqlite.hpp"

namespace lekalo::server {

/// Says whether a stock file is made where there is none.
enum class StockOpening : std::uint8_t { make, find };

/// The stock of a shop in one SQLite file, which any number of processes may use at the same time: whatever
/// changes it is one transaction with everything that it was decided by, so no piece is given to two orders,
/// and a process that is killed at any moment leaves the state before or after. docs/design/stock.md says
/// how.
///
/// Functions fail with ErrorCode::environment where the disk or another process does not let them, and with
/// ErrorCode::bad_input and one sentence for what cannot be, as an order that is not there; then nothing is
/// changed. Each reads the whole file but its layouts: O(pieces and orders of all time).
class StockFile {
 public:
  /// Fails with ErrorCode::bad_input where there is no file to be found, for another file than a stock file,
  /// and for one that is damaged.
  [[nodiscard]] static Result<StockFile> open(const std::string& path, StockOpening opening);

  /// Returns everything in it. Fails with ErrorCode::bad_input for rows that do not fit their digests.
  [[nodiscard]] Result<jobs::StockBook> book();
  /// Returns the pieces, also those that are gone.
  [[nodiscard]] Result<std::vector<jobs::StockItem>> items();

  /// Adds pieces, and changes the rule of the remnants to come. Fails for a rule that no piece there is large
  /// enough for. Returns the pieces that came.
  [[nodiscard]] Result<std::vector<jobs::StockItem>> add(const std::vector<layout::Stock>& pieces,
                                                         const std::optional<layout::RemnantRule>& rule);
  /// Allocates what layouts use (jobs::uses_of) to an order. Fails for an order that is allocated or was cut.
  [[nodiscard]] Result<jobs::StockOrder> allocate(const std::string& order,
                                                  const std::vector<jobs::LayoutToCut>& layouts);
  /// An order that was cut, with what it used, and what came back.
  struct Cut {
    jobs::StockOrder order;
    std::vector<jobs::StockItem> remnants;
  };
  /// Takes what an order uses out of the stock, and puts the remnants in.
  /// \param layouts  as it was cut; empty: those that it was allocated by. What they do not use is free again
  [[nodiscard]] Result<Cut> cut(const std::string& order, const std::vector<jobs::LayoutToCut>& layouts);
  /// Gives back what is allocated to an order. Fails for one that was cut.
  [[nodiscard]] Result<jobs::StockOrder> cancel(const std::string& order);

 private:
  StockFile(std::string path, Database database) : path_(std::move(path)), database_(std::move(database)) {}

  enum class Layouts : std::uint8_t { read, left };
  [[nodiscard]] Result<jobs::StockBook> read(Layouts layouts) const;
  [[nodiscard]] Result<std::vector<jobs::StockItem>> read_items() const;
  [[nodiscard]] Result<std::vector<jobs::StockOrder>> read_orders() const;
  [[nodiscard]] Result<void> read_uses(std::vector<jobs::StockOrder>& orders) const;
  [[nodiscard]] Result<void> read_layouts(jobs::StockOrder& order) const;
  [[nodiscard]] Result<void> put(jobs::StockItem& item) const;
  [[nodiscard]] Result<void> put(const jobs::StockOrder& order) const;
  [[nodiscard]] Result<jobs::StockOrder> find(const jobs::StockBook& book, const std::string& order) const;
  /// A failure that names the file.
  [[nodiscard]] Error at_file(Error error) const;
  [[nodiscard]] tl::unexpected<Error> refused(const std::string& sentence) const;
  template <class Value>
  [[nodiscard]] Result<Value> named(Result<Value> result) const;
  /// Runs work(book) in a transaction, and commits it where it succeeds.
  template <class Work>
  [[nodiscard]] auto change(const Work& work) const;

  std::string path_;
  Database database_;
};

}  // namespace lekalo::server
