#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "ipopt_model.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/locate/reference.hpp"
#include "start.hpp"

#ifdef LEKALO_WITH_IPOPT
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#endif

namespace lekalo::locate {

#ifndef LEKALO_WITH_IPOPT

Result<ReferenceResult> locate_ipopt(const geom::ConvexPolygon&, const geom::ConvexPolygon&,
                                     const IpoptOptions&) {
  return failure(ErrorCode::environment,
                 "This build has no IPOPT: use the certified method, or build with LEKALO_WITH_IPOPT.");
}

#else

namespace {

using geom::Point;
using Stage = NonlinearModel::Stage;
using Variables = NonlinearModel::Variables;

// Lengths are in units of half the blank's larger side. The clearance found is short of the local maximum by
// about this.
constexpr double kTolerance = 1e-9;
constexpr int kMaxIterations = 1000;
constexpr double kUnbounded = 2e19;  // beyond IPOPT's nlp_upper_bound_inf

struct LocalSolution {
  Variables z{};
  std::uint64_t iterations = 0;
  bool converged = false;
};

/// One stage from one start, in the form that IPOPT asks for.
class StageProgram final : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  StageProgram(const NonlinearModel& model, Stage stage, const AngleWindow& window, const Variables& start,
               const RunControl& run)
      : model_(model), stage_(stage), window_(window), start_(start), run_(run) {
    solution_.z = start;
  }

  [[nodiscard]] const LocalSolution& solution() const noexcept { return solution_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(NonlinearModel::kVariables);
    m = static_cast<Index>(model_.rows());
    jacobian_entries = n * m;
    hessian_entries = static_cast<Index>(NonlinearModel::kHessianEntries);
    style = TNLP::C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* low, Number* high, Index m, Number* row_low,
                       Number* row_high) override {
    const bool free_angle = window_.full_circle();
    const Variables lows{-kUnbounded, -kUnbounded, free_angle ? -kUnbounded : window_.from, 0};
    const Variables highs{kUnbounded, kUnbounded, free_angle ? kUnbounded : window_.to,
                          stage_ == Stage::homothety ? 1 : kUnbounded};
    std::copy(lows.begin(), lows.end(), low);
    std::copy(highs.begin(), highs.end(), high);
    std::fill_n(row_low, m, 0.0);
    std::fill_n(row_high, m, kUnbounded);
    return true;
  }

  bool get_starting_point(Index, bool, Number* z, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy(start_.begin(), start_.end(), z);
    return true;
  }

  bool eval_f(Index, const Number* z, bool, Number& value) override {
    value = -z[3];
    return true;
  }

  bool eval_grad_f(Index, const Number*, bool, Number* gradient) override {
    std::fill_n(gradient, NonlinearModel::kVariables, 0.0);
    gradient[3] = -1;
    return true;
  }

  bool eval_g(Index, const Number* z, bool, Index, Number* values) override {
    if (!usable(z)) return false;
    model_.constraints(stage_, variables(z), values);
    return true;
  }

  bool eval_jac_g(Index n, const Number* z, bool, Index m, Index, Index* rows, Index* columns,
                  Number* values) override {
    if (values == nullptr) {
      for (Index row = 0; row < m; ++row) {
        for (Index column = 0; column < n; ++column) {
          *rows++ = row;
          *columns++ = column;
        }
      }
      return true;
    }
    if (!usable(z)) return false;
    model_.jacobian(stage_, variables(z), values);
    return true;
  }

  bool eval_h(Index, const Number* z, bool, Number, Index, const Number* multipliers, bool, Index,
              Index* rows, Index* columns, Number* values) override {
    if (values == nullptr) {
      rows[0] = columns[0] = 2;
      rows[1] = 3;
      columns[1] = 2;
      return true;
    }
    if (!usable(z)) return false;
    model_.hessian(stage_, variables(z), multipliers, values);
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number, Number,
                             Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    solution_.iterations = static_cast<std::uint64_t>(iteration);
    return !run_.stop_requested();
  }

  void finalize_solution(Ipopt::SolverReturn status, Index, const Number* z, const Number*, const Number*,
                         Index, const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    if (!usable(z)) return;
    solution_.z = variables(z);
    solution_.converged = status == Ipopt::SUCCESS;
  }

 private:
  static Variables variables(const Number* z) { return {z[0], z[1], z[2], z[3]}; }

  /// Says whether a step has run away. IPOPT shortens such a step when it is told that the functions have no
  /// value there.
  static bool usable(const Number* z) {
    return std::isfinite(z[0]) && std::isfinite(z[1]) && std::isfinite(z[3]) &&
           std::abs(z[2]) <= geom::kMaxAngle;
  }

  const NonlinearModel& model_;
  Stage stage_;
  AngleWindow window_;
  Variables start_;
  const RunControl& run_;
  LocalSolution solution_;
};

/// Draws the start poses of stage 1 by the rule chosen.
class StartPoses {
 public:
  StartPoses(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank, const IpoptOptions& options)
      : blank_(blank),
        rule_(options.start_rule),
        window_(options.window),
        part_moments_(outline_moments(part)),
        blank_moments_(outline_moments(blank)),
        random_(options.seed) {}

  /// Returns nullopt when the rule has no more.
  std::optional<NonlinearModel::Pose> next() {
    switch (rule_) {
      case StartRule::random: {
        const Point where = random_point(blank_, random_);
        return at(where, random_angle());
      }
      case StartRule::centroids:
        return at(blank_moments_.centroid, random_angle());
      case StartRule::principal_axes:
        break;
    }
    if (drawn_ == 2) return std::nullopt;
    const double angle = aligned_axes(part_moments_, blank_moments_)[drawn_++];
    return at(blank_moments_.centroid, nearest_in(window_, angle));
  }

 private:
  double random_angle() { return random_.uniform(window_.from, window_.to); }

  /// Returns the pose with the part's centroid there, turned by theta.
  [[nodiscard]] NonlinearModel::Pose at(Point centroid, double theta) const {
    return {translation_onto(part_moments_.centroid, centroid, theta), theta};
  }

  const geom::ConvexPolygon& blank_;
  StartRule rule_;
  AngleWindow window_;
  OutlineMoments part_moments_, blank_moments_;
  Random random_;
  std::size_t drawn_ = 0;
};

class Multistart {
 public:
  Multistart(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank, const IpoptOptions& options)
      : part_(part), blank_(blank), options_(options), model_(part, blank), poses_(part, blank, options) {}

  Result<ReferenceResult> run() {
    if (!prepare_solver())
      return failure(ErrorCode::environment, "IPOPT does not start with its own options.");
    const std::uint64_t draws =
        static_cast<std::uint64_t>(options_.starts) * static_cast<std::uint64_t>(kDrawsPerStart);
    const std::uint64_t limit = std::min(draws, options_.run.work_limit);
    for (std::uint64_t draw = 0; draw < limit && result_.starts_done < options_.starts; ++draw) {
      const auto pose = poses_.next();
      if (!pose) break;
      const Variables start = model_.variables(*pose, 0);
      if (!result_.found) consider(start, false);
      if (options_.run.stop_requested()) break;
      optimise_from(start);
      report(draw + 1, limit);
    }
    // Without any work allowed there is still a valid placement, the first one drawn.
    if (!seen_) consider(model_.variables(poses_.next().value(), 0), false);
    return result_;
  }

 private:
  bool prepare_solver() {
    const auto options = solver_->Options();
    options->SetIntegerValue("print_level", 0);
    options->SetStringValue("sb", "yes");
    options->SetNumericValue("tol", kTolerance);
    options->SetIntegerValue("max_iter", kMaxIterations);
    // The empty name keeps IPOPT from reading an ipopt.opt that happens to lie in the working directory.
    return solver_->Initialize("") == Ipopt::Solve_Succeeded;
  }

  LocalSolution solve(Stage stage, const Variables& start) {
    const Ipopt::SmartPtr<StageProgram> program =
        new StageProgram(model_, stage, options_.window, start, options_.run);
    solver_->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(program)));
    result_.iterations += program->solution().iterations;
    return program->solution();
  }

  void optimise_from(const Variables& start) {
    const LocalSolution shrunk = solve(Stage::homothety, start);
    if (!(shrunk.z[3] >= 1 - kHomothetyTolerance)) {
      ++result_.starts_rejected;
      if (!result_.found) consider(shrunk.z, false);
      return;
    }
    const LocalSolution local = solve(Stage::clearance, {shrunk.z[0], shrunk.z[1], shrunk.z[2], 0});
    // From here on only optimised starts count.
    if (!result_.found) seen_ = false;
    result_.found = true;
    ++result_.starts_done;
    consider(local.z, local.converged);
  }

  /// Keeps the pose when it is the best so far, by its true clearance.
  void consider(Variables z, bool converged) {
    z[2] = nearest_in(options_.window, z[2]);
    const NonlinearModel::Pose pose = model_.placement(z);
    const Placement placement =
        measured_placement(part_, blank_, pose.translation.x, pose.translation.y, pose.theta);
    if (seen_ && !(placement.clearance > result_.best.clearance)) return;
    seen_ = true;
    result_.best = placement;
    result_.converged = converged;
  }

  void report(std::uint64_t work, std::uint64_t limit) const {
    if (!options_.run.progress) return;
    const double by_draws = static_cast<double>(work) / static_cast<double>(limit);
    const double by_starts = static_cast<double>(result_.starts_done) / options_.starts;
    options_.run.progress({work, std::max(by_draws, by_starts)});
  }

  const geom::ConvexPolygon& part_;
  const geom::ConvexPolygon& blank_;
  const IpoptOptions& options_;
  NonlinearModel model_;
  StartPoses poses_;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> solver_ = new Ipopt::IpoptApplication(false);
  ReferenceResult result_;
  bool seen_ = false;
};

Result<void> check_options(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                           const IpoptOptions& options) {
  LEKALO_CHECK(check_window(options.window));
  if (options.starts < 1) {
    return failure(ErrorCode::usage, fmt::format("IPOPT needs at least 1 start, not {}.", options.starts));
  }
  if (part.size() > kMaxIpoptConstraints / blank.size()) {
    return failure(ErrorCode::usage,
                   fmt::format("IPOPT would get {} x {} constraints, more than {}: use the certified method.",
                               blank.size(), part.size(), kMaxIpoptConstraints));
  }
  return {};
}

}  // namespace

Result<ReferenceResult> locate_ipopt(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                                     const IpoptOptions& options) {
  LEKALO_CHECK(check_options(part, blank, options));
  return Multistart(part, blank, options).run();
}

#endif

}  // namespace lekalo::locate
