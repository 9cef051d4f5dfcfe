// Nests what a layout, or a job of another program, wants, for a million units of work, and writes a layout that
// two independent checks found to break no rule:
//   nest JOB.json LAYOUT.json
#include <iostream>

#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/jobs/nest.hpp"

namespace {

lekalo::Result<void> run(const char* job, const char* output) {
  LEKALO_TRY(std::string bytes, lekalo::disk::read_file(job));
  LEKALO_TRY(const lekalo::jobs::Layout layout, lekalo::jobs::open_layout({job, std::move(bytes)}));
  lekalo::RunControl control;
  control.work_limit = 1'000'000;
  LEKALO_TRY(const lekalo::jobs::Nested nested, lekalo::jobs::nest(layout.document, {}, control));
  std::cout << nested.document.placements.size() << " placed, density " << nested.completeness.density
            << '\n';
  lekalo::disk::AtomicFiles files;
  LEKALO_CHECK(files.add(output, nested.bytes));
  return files.commit();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: nest JOB.json LAYOUT.json\n";
    return 2;
  }
  const auto done = run(argv[1], argv[2]);
  if (!done) std::cerr << done.error().message << '\n';
  return done ? 0 : lekalo::exit_status(done.error().code);
}
