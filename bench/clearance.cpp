// The clearance of 1,000,000 points around a body of 100,000 triangles, at one pose after another.

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>

#include "lekalo/base/random.hpp"
#include "lekalo/solid/clearance.hpp"

namespace {

using lekalo::solid::Vector;

/// A wavy ball; `grow` is the stock on it.
Vector surface(double polar, double around, double grow) {
  const double r =
      50 + 4 * std::sin(3 * polar) * std::sin(2 * around) + 3 * std::cos(5 * around) * std::sin(polar) + grow;
  return {r * std::sin(polar) * std::cos(around), 0.7 * r * std::sin(polar) * std::sin(around),
          1.2 * r * std::cos(polar)};
}

lekalo::solid::Mesh body(std::uint32_t rows, std::uint32_t across) {
  lekalo::solid::Mesh mesh;
  mesh.vertices.push_back(surface(0, 0, 0));
  for (std::uint32_t i = 1; i <= rows; ++i)
    for (std::uint32_t j = 0; j < across; ++j)
      mesh.vertices.push_back(
          surface(std::numbers::pi * i / (rows + 1), 2 * std::numbers::pi * j / across, 0));
  mesh.vertices.push_back(surface(std::numbers::pi, 0, 0));
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t j = 0; j < across; ++j) {
    const std::uint32_t next = (j + 1) % across, bottom = 1 + (rows - 1) * across;
    mesh.triangles.push_back({0, 1 + j, 1 + next});
    mesh.triangles.push_back({last, bottom + next, bottom + j});
    for (std::uint32_t i = 0; i + 1 < rows; ++i) {
      const std::uint32_t p = 1 + i * across + j, q = 1 + i * across + next;
      mesh.triangles.push_back({p, p + across, q});
      mesh.triangles.push_back({q, p + across, q + across});
    }
  }
  return mesh;
}

/// Processor time, of all threads.
double milliseconds_since(std::clock_t start) {
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

/// bench_clearance [CELL]
/// CELL is that of the field of bounds, mm.
int main(int argc, char** argv) {
  const double cell = argc > 1 ? std::strtod(argv[1], nullptr) : 0.35;
  const auto mesh = lekalo::solid::closed_mesh(body(223, 224));
  if (!mesh) {
    fmt::print("{}\n", mesh.error().message);
    return EXIT_FAILURE;
  }
  auto start = std::clock();
  const lekalo::solid::TriangleTree tree(mesh->mesh);
  fmt::print("{} triangles, tree {:.0f} ms\n", mesh->mesh.triangles.size(), milliseconds_since(start));
  for (const double noise : {0.0, 0.02, 0.1}) {
    lekalo::Random random(1);
    std::vector<Vector> points;
    for (int i = 0; i < 1000; ++i)
      for (int j = 0; j < 1000; ++j)
        points.push_back(surface(std::numbers::pi * (i + 0.5) / 1000, 2 * std::numbers::pi * (j + 0.5) / 1000,
                                 2 + random.uniform(-2 * noise, 2 * noise)));
    for (const unsigned threads : {1U, 2U}) {
      lekalo::solid::ClearanceMeter meter(tree, points, cell, threads);
      double first = 0, again = 0;
      lekalo::solid::Clearance found;
      constexpr int kPoses = 20;
      for (int pose = 0; pose <= kPoses; ++pose) {
        const double angle = 0.0002 * pose, c = std::cos(angle), s = std::sin(angle);
        const lekalo::solid::Motion motion{{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}},
                                           {0.005 * pose, -0.002 * pose, 0.003 * pose}};
        start = std::clock();
        found = meter.at(motion);
        (pose == 0 ? first : again) += milliseconds_since(start);
      }
      // Poses far from each other, about the same one; the same for any number of threads. The rounds show
      // what is left to be made at new places once some have been asked for.
      lekalo::Random drawn(2);
      std::string far;
      lekalo::solid::Clearance least = found;
      for (int round = 0; round < 10; ++round) {
        double of_round = 0, clock = 0;
        for (int pose = 0; pose < kPoses; ++pose) {
          const double angle = drawn.uniform(-0.02, 0.02), c = std::cos(angle), s = std::sin(angle);
          const lekalo::solid::Motion motion{
              {{{1, 0, 0}, {0, c, -s}, {0, s, c}}},
              {drawn.uniform(-0.5, 0.5), drawn.uniform(-0.5, 0.5), drawn.uniform(-0.5, 0.5)}};
          start = std::clock();
          const auto by_clock = std::chrono::steady_clock::now();
          const lekalo::solid::Clearance there = meter.at(motion);
          of_round += milliseconds_since(start);
          clock +=
              std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - by_clock).count();
          if (there.low < least.low) least = there;
        }
        far += fmt::format("{}{:.1f} ({:.1f})", round > 0 ? ", " : "", of_round / kPoses, clock / kPoses);
      }
      fmt::print(
          "noise {:g} mm, {} threads: first pose {:.0f} ms, then {:.1f} ms each to {:.9f} mm; far from each "
          "other in rounds {} ms each, by the clock in brackets, the least {:.9f} mm\n",
          noise, threads, first, again / kPoses, found.low, far, least.low);
    }
  }
}
