#include "certificate_leaf.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

enum class Answer : std::uint8_t { no, open, yes };

/// The sign of an enclosure tells, where it is sure.
Answer at_most_zero(Span value) { return static_cast<Answer>(1 - sure_sign(value)); }
Answer at_most_zero(const Fraction& value) { return sgn(value) <= 0 ? Answer::yes : Answer::no; }
Answer below_zero(Span value) { return at_most_zero(value); }
Answer below_zero(const Fraction& value) { return sgn(value) < 0 ? Answer::yes : Answer::no; }

// ---- the arithmetic of spans and of fractions -------------------------------------------------------------

/// Returns 1 / |n|, whose error as a fraction makes it no more where it is to be `below`, and else no less.
/// \pre n is not 0
Span inverse_length(const Vec3& n, bool /*below*/) { return just(1) / length(n); }
Fraction inverse_length(const Exact3& n, bool below) {
  // |n| = sqrt(p / q) = sqrt(p q) / q; where that is no fraction, it is cut at 2^-128 of itself, or finer.
  const Fraction squared = dot(n, n);
  const Integer product = squared.get_num() * squared.get_den();
  constexpr unsigned long kPlaces = 128;
  Integer root = whole_root(product << (2 * kPlaces));
  if (below && root * root != product << (2 * kPlaces)) root += 1;
  Fraction inverse(squared.get_den() << kPlaces, root);
  inverse.canonicalize();
  return inverse;
}

template <class Number>
Number number(double value) {
  if constexpr (std::is_same_v<Number, Span>)
    return just(value);
  else
    return value;
}
template <class Number>
Of3<Number> vertex(const SolidMesh& mesh, std::uint32_t v) {
  if constexpr (std::is_same_v<Number, Span>)
    return {mesh.enclosed(v, 0), mesh.enclosed(v, 1), mesh.enclosed(v, 2)};
  else
    return {mesh.exact(v, 0), mesh.exact(v, 1), mesh.exact(v, 2)};
}

Near3 near(const Vec3& p) {
  return {p[0].low / 2 + p[0].high / 2, p[1].low / 2 + p[1].high / 2, p[2].low / 2 + p[2].high / 2};
}

// ---- polynomials ------------------------------------------------------------------------------------------

/// For each t the form level + slope . t + bend |u|^2 + (R(x) p) . u, where u = from + turn t + around x t.
template <class Number>
struct Form {
  Of3<Number> p, from;
  Number turn{}, level{}, bend{};
  Of3<Number> slope{};
  std::optional<Of3<Number>> around = {};
  Number weight = number<Number>(1);
};

/// A polynomial of degree 2 in x; mixed[k] belongs to the product of the other two.
template <class Number>
struct Quadratic {
  Number constant{};
  Of3<Number> linear{}, square{}, mixed{};

  /// Adds the form, times its weight and 1 + |x|^2, at one t:
  /// (1 + |x|^2) R(x) p = (1 - |x|^2) p + 2 x cross p + 2 (x . p) x.
  void add(const Form<Number>& form, const Of3<Number>& t) {
    Of3<Number> u = form.from + t * form.turn;
    if (form.around) u = u + cross(*form.around, t);
    const Number level = form.level + dot(form.slope, t) + form.bend * dot(u, u), along = dot(form.p, u);
    const Of3<Number> turning = cross(form.p, u);
    const Number twice = form.weight + form.weight;
    constant = constant + form.weight * (level + along);
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      linear[a] = linear[a] + twice * turning[a];
      square[a] = square[a] + form.weight * (level - along) + twice * (form.p[a] * u[a]);
      mixed[a] = mixed[a] + twice * (form.p[b] * u[c] + form.p[c] * u[b]);
    }
  }
};

/// The box of a leaf.
template <class Number>
class Cell {
 public:
  explicit Cell(const PoseBox& box) {
    for (std::size_t k = 0; k < 3; ++k) {
      ends_[k] = {as<Number>(box.low[k]), as<Number>(box.high[k])};
      const Number low = as<Number>(box.low[k + 3]), high = as<Number>(box.high[k + 3]);
      x_[k] = {low, Number((low + high) * number<Number>(0.5)), high};
      squares_[k] = {Number(low * low), Number(low * high), Number(high * high)};
    }
  }

  /// Says whether the sum of forms is nowhere above 0, by its Bernstein coefficients.
  [[nodiscard]] Answer nowhere_positive(const std::vector<Form<Number>>& forms) const {
    return each(forms, [](const Number& coefficient) { return at_most_zero(coefficient); });
  }
  /// Says whether it is below 0 everywhere.
  [[nodiscard]] Answer everywhere_negative(const std::vector<Form<Number>>& forms) const {
    return each(forms, [](const Number& coefficient) { return below_zero(coefficient); });
  }

 private:
  template <class Asked>
  [[nodiscard]] Answer each(const std::vector<Form<Number>>& forms, const Asked& asked) const {
    Answer answer = Answer::yes;
    for (unsigned corner = 0; corner < 8; ++corner) {
      ask(std::is_same_v<Number, Span> ? 4 : 1000);
      Quadratic<Number> sum;
      for (const Form<Number>& form : forms)
        sum.add(form, {ends_[0][corner & 1], ends_[1][corner >> 1 & 1], ends_[2][corner >> 2]});
      answer = std::min(answer, each(sum, asked));
      if (answer == Answer::no) break;
    }
    return answer;
  }

  template <class Asked>
  [[nodiscard]] Answer each(const Quadratic<Number>& q, const Asked& asked) const {
    std::array<std::array<Number, 3>, 3> alone;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t i = 0; i < 3; ++i) alone[a][i] = q.linear[a] * x_[a][i] + q.square[a] * squares_[a][i];
    Answer answer = Answer::yes;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const Number flat = q.constant + alone[0][i] + alone[1][j] + q.mixed[2] * x_[0][i] * x_[1][j];
        const Number slope = q.mixed[1] * x_[0][i] + q.mixed[0] * x_[1][j];
        for (std::size_t k = 0; k < 3; ++k) {
          const Number coefficient = flat + alone[2][k] + slope * x_[2][k];
          answer = std::min(answer, asked(coefficient));
        }
      }
    return answer;
  }

  std::array<std::array<Number, 2>, 3> ends_;
  std::array<std::array<Number, 3>, 3> x_, squares_;
};

// ---- terms ------------------------------------------------------------------------------------------------

template <class Number>
struct Facet {
  std::array<Of3<Number>, 3> at, inwards;
  Of3<Number> normal;

  Facet(const SolidMesh& mesh, std::uint32_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) at[k] = vertex<Number>(mesh, mesh.triangles[triangle][k]);
    normal = verify::normal(at);
    for (std::size_t k = 0; k < 3; ++k) inwards[k] = cross(normal, at[(k + 1) % 3] - at[k]);
  }
};

/// The ends of an edge.
template <class Number>
std::array<Of3<Number>, 2> edge_of(const SolidMesh& mesh, std::uint32_t edge) {
  const auto& t = mesh.triangles[edge / 3];
  return {vertex<Number>(mesh, t[edge % 3]), vertex<Number>(mesh, t[(edge + 1) % 3])};
}

/// Tells in doubles where things are at the middle of the leaf. It proves nothing.
class Middle {
 public:
  Middle(const PoseBox& box, const LeafFrame& frame) : frame_(frame), pivot_(as<Span>(frame.pivot)) {
    const auto middle = [&](std::size_t k) { return box.low[k].near.low / 2 + box.high[k].near.high / 2; };
    for (std::size_t k = 0; k < 3; ++k) t_[k] = middle(k), x_[k] = middle(k + 3);
  }
  [[nodiscard]] Near3 place(const Both3& p) const { return turned(as<Span>(p) - pivot_) + t_; }
  [[nodiscard]] Near3 place(const Vec3& p) const { return turned(p - pivot_) + t_; }
  [[nodiscard]] Near3 turned(const Vec3& way) const {
    const Near3 p = near(frame_.turn(way));
    const double square = dot(x_, x_);
    return (p * (1 - square) + cross(x_, p) * 2.0 + x_ * (2 * dot(x_, p))) * (1 / (1 + square));
  }

 private:
  const LeafFrame& frame_;
  Vec3 pivot_;
  Near3 t_{}, x_{};
};

/// Directions are shorter than 1 by more than rounding makes them longer; and of edges at no such angle
/// doubles tell none.
constexpr double kShorter = 0x1p-50, kLeastAngle = 1e-100;

template <class Number>
class LeafProof {
 public:
  LeafProof(const std::vector<LeafTerm>& terms, const PoseBox& box, const LeafFrame& frame)
      : terms_(terms), frame_(frame), cell_(box), middle_(box, frame), pivot_(as<Number>(frame.pivot)) {}

  Answer answer() {
    Answer all = Answer::yes;
    std::vector<Form<Number>> forms;
    for (const LeafTerm& term : terms_) {
      const std::size_t before = forms.size();
      all = std::min(all, add(term, forms));
      if (all == Answer::no) return all;
      for (std::size_t k = before; k < forms.size(); ++k) forms[k].weight = as<Number>(term.multiplier);
    }
    const bool of_place = std::ranges::all_of(terms_, [](const LeafTerm& term) { return term.of_place(); });
    return std::min(all, of_place ? cell_.everywhere_negative(forms) : cell_.nowhere_positive(forms));
  }

 private:
  using Point = Of3<Number>;

  [[nodiscard]] const Both& bound_of(const LeafTerm& term) const {
    return term.bound != nullptr ? *term.bound : frame_.bound;
  }
  static Point negative(const Point& p) { return Point{} - p; }
  [[nodiscard]] Point turned(const Point& way) const { return frame_.turn(way); }

  /// Adds the form of a term, and says whether it counts over the whole box.
  Answer add(const LeafTerm& term, std::vector<Form<Number>>& forms) const {
    switch (term.kind) {
      case LeafTerm::Kind::ball:
      case LeafTerm::Kind::point:
        return add_ball(term, forms);
      case LeafTerm::Kind::plane:
      case LeafTerm::Kind::point_plane:
        return add_plane(term, forms);
      case LeafTerm::Kind::face:
      case LeafTerm::Kind::point_face:
        return add_blank_face(term, forms);
      case LeafTerm::Kind::part_face:
        return add_part_face(term, forms);
      case LeafTerm::Kind::datum:
        return add_datum(*term.held, forms);
      case LeafTerm::Kind::near:
        return add_near(term, forms);
      case LeafTerm::Kind::edges:
        break;
    }
    return add_edges(term, forms);
  }

  Answer add_ball(const LeafTerm& term, std::vector<Form<Number>>& forms) const {
    const Number bound = as<Number>(bound_of(term));
    const Ball &a = *term.part_ball, &c = *term.blank_ball;
    const double apart = std::sqrt(squared_length(middle_.place(a.centre) - near(as<Span>(c.centre))));
    const Number l = number<Number>(apart > 0 ? apart : 1), inverse = number<Number>(1) / l,
                 half = number<Number>(0.5);
    const Point way = as<Number>(a.centre) - pivot_;
    Form<Number> form{turned(way), as<Number>(c.centre) * Number(number<Number>(0) - inverse)};
    form.turn = inverse;
    form.level = half * (dot(way, way) * inverse + l) - as<Number>(a.radius) - as<Number>(c.radius) - bound;
    form.bend = half * l;
    forms.push_back(std::move(form));
    return term.kind == LeafTerm::Kind::point ? Answer::yes : not_below_zero(bound + as<Number>(c.radius));
  }

  Answer add_plane(const LeafTerm& term, std::vector<Form<Number>>& forms) const {
    const Number bound = as<Number>(bound_of(term));
    const Ball& a = *term.part_ball;
    const Point n = as<Number>(term.plane->normal);
    const bool sticks_out = sgn(Fraction(a.radius.exact + bound_of(term).exact)) == -1;
    const Number inverse = inverse_length(n, sticks_out);
    Form<Number> form{turned(as<Number>(a.centre) - pivot_), n * inverse};
    form.slope = form.from;
    form.level = number<Number>(0) - as<Number>(term.plane->level) * inverse - as<Number>(a.radius) - bound;
    forms.push_back(std::move(form));
    return Answer::yes;
  }

  Answer add_near(const LeafTerm& term, std::vector<Form<Number>>& forms) const {
    const Point p = turned(as<Number>(term.part_ball->centre) - pivot_);
    const std::size_t side = term.blank % 6;
    Answer all = Answer::yes;
    for (std::size_t s = 0; s < 6; ++s) {
      const FarBody::Side& one = term.body->sides[s];
      const Point n = point(one.normal);
      const Number scale = inverse_length(n, false);
      Form<Number> form{p, negative(n) * scale};
      form.slope = form.from, form.level = value(one.level) * scale;
      if (s == side)
        forms.push_back(std::move(form));
      else
        all = std::min(all, cell_.everywhere_negative(std::vector<Form<Number>>{std::move(form)}));
    }
    return all;
  }

  Answer add_datum(const HeldPoint& held, std::vector<Form<Number>>& forms) const {
    const Point u = as<Number>(held.direction);
    Form<Number> form{turned(as<Number>(held.place) - pivot_), negative(u)};
    form.slope = form.from;
    form.level = as<Number>(held.within) / inverse_length(u, true) + dot(u, as<Number>(held.through));
    forms.push_back(std::move(form));
    return Answer::yes;
  }

  Answer add_blank_face(const LeafTerm& term, std::vector<Form<Number>>& forms) const {
    const Number bound = as<Number>(bound_of(term));
    const Ball& a = *term.part_ball;
    const Facet<Number> face(frame_.blank, term.blank);
    const Facet<Span> seen(frame_.blank, term.blank);
    if (!has_area(face)) return add_nothing(forms);
    const bool below = std::signbit(dot(near(seen.normal), middle_.place(a.centre) - near(seen.at[0])));
    const Number inverse = inverse_length(face.normal, false);
    const Point n = (below ? negative(face.normal) : face.normal) * inverse,
                p = turned(as<Number>(a.centre) - pivot_);
    /// Holds the ball's centre against a half-space.
    const auto form_of = [&](const Point& normal, const Number& level) {
      Form<Number> form{p, normal};
      form.slope = normal, form.level = level;
      return form;
    };
    const Number foot = dot(n, face.at.front()), radius = as<Number>(a.radius),
                 width = number<Number>(frame_.blank.width(term.blank).low);
    forms.push_back(form_of(n, number<Number>(0) - foot - radius - width - bound));
    Answer all = std::min(not_below_zero(bound), nowhere_positive(form_of(negative(n), foot - radius)));
    for (std::size_t k = 0; k < 3; ++k)
      all = std::min(all,
                     nowhere_positive(form_of(negative(face.inwards[k]), dot(face.inwards[k], face.at[k]))));
    return all;
  }

  Answer add_part_face(const LeafTerm& term, std::vector<Form<Number>>& forms) const {
    const Number bound = as<Number>(bound_of(term));
    const Ball& c = *term.blank_ball;
    const Facet<Number> face(frame_.part, term.part);
    const Facet<Span> seen(frame_.part, term.part);
    if (!has_area(face)) return add_nothing(forms);
    const bool below =
        std::signbit(dot(middle_.turned(seen.normal), near(as<Span>(c.centre)) - middle_.place(seen.at[0])));
    const Number inverse = inverse_length(face.normal, false);
    const Point n = (below ? negative(face.normal) : face.normal) * inverse;
    /// Holds the ball's centre, as the part sees it, against a half-space: n . (T^-1 c - pivot) is
    /// (R turn n) . (c - t).
    const auto form_of = [&](const Point& normal, const Number& level) {
      Form<Number> form{turned(normal), as<Number>(c.centre)};
      form.turn = number<Number>(-1), form.level = level;
      return form;
    };
    const Number foot = dot(n, face.at[0] - pivot_), radius = as<Number>(c.radius);
    forms.push_back(form_of(n, number<Number>(0) - foot - radius - bound));
    Answer all = std::min(not_below_zero(bound), nowhere_positive(form_of(negative(n), foot - radius)));
    for (std::size_t k = 0; k < 3; ++k)
      all = std::min(all, nowhere_positive(
                              form_of(negative(face.inwards[k]), dot(face.inwards[k], face.at[k] - pivot_))));
    return all;
  }

  Answer add_edges(const LeafTerm& term, std::vector<Form<Number>>& forms) const {
    const Number bound = as<Number>(bound_of(term));
    const auto [a, b] = edge_of<Number>(frame_.part, term.part);
    auto ends = edge_of<Number>(frame_.blank, term.blank);
    Near3 n{};
    {
      const auto [near_a, near_b] = edge_of<Span>(frame_.part, term.part);
      const auto [near_q, near_r] = edge_of<Span>(frame_.blank, term.blank);
      n = cross(middle_.turned(near_b - near_a), near(near_r - near_q));
      if (std::signbit(dot(n, middle_.place(near_a) - near(near_q))))
        std::swap(ends[0], ends[1]), n = n * -1.0;
    }
    const double angle = std::sqrt(squared_length(n));
    if (!(angle > kLeastAngle)) return add_nothing(forms);
    const Point &q = ends[0], &r = ends[1];
    const Point p = turned(a - pivot_), d = turned(b - a), g = r - q, u = point(n * ((1 - kShorter) / angle)),
                beside = cross(g, u);
    /// (R d x along) . (T a - from).
    const auto passing = [&](const Point& from, const Point& along) {
      std::vector<Form<Number>> made{{cross(p, d), along}, {d, cross(from, along)}};
      made[1].around = along;
      return made;
    };
    /// The half-space to a side of the blank's edge, for an end of the part's.
    const auto over = [&](const Point& end, const Point& side) {
      Form<Number> form{end, side};
      form.slope = side, form.level = dot(negative(side), q);
      return std::vector<Form<Number>>{form};
    };
    const Number width = number<Number>(frame_.blank.width(term.blank / 3).low);
    for (Form<Number>& form : passing(q + u * Number(width + bound), g * number<Number>(1 / angle)))
      forms.push_back(std::move(form));
    Answer all = not_below_zero(bound);
    for (const auto& condition : {passing(q, negative(g)), passing(q, u), passing(r, negative(u)),
                                  over(p, beside), over(turned(b - pivot_), negative(beside))})
      all = std::min(all, cell_.everywhere_negative(condition));
    return all;
  }

  static Point point(const Near3& p) {
    return {number<Number>(p[0]), number<Number>(p[1]), number<Number>(p[2])};
  }

  static Number value(const Fraction& exact) {
    if constexpr (std::is_same_v<Number, Span>)
      return enclosed(exact);
    else
      return exact;
  }
  static Point point(const Exact3& p) { return {value(p[0]), value(p[1]), value(p[2])}; }

  static bool has_area(const Facet<Span>& /*face*/) { return true; }
  static bool has_area(const Facet<Fraction>& face) { return sgn(dot(face.normal, face.normal)) != 0; }
  static Answer add_nothing(std::vector<Form<Number>>& forms) {
    forms.emplace_back();
    return Answer::no;
  }

  static Answer not_below_zero(const Number& value) {
    return at_most_zero(Number(number<Number>(0) - value));
  }
  [[nodiscard]] Answer nowhere_positive(const Form<Number>& form) const {
    return cell_.nowhere_positive(std::vector<Form<Number>>{form});
  }
  static double squared_length(const Near3& p) { return dot(p, p); }

  const std::vector<LeafTerm>& terms_;
  const LeafFrame& frame_;
  Cell<Number> cell_;
  Middle middle_;
  Point pivot_;
};

}  // namespace

bool proves(const std::vector<LeafTerm>& terms, const PoseBox& box, const LeafFrame& frame) {
  const Answer quick = LeafProof<Span>(terms, box, frame).answer();
  return quick == Answer::open ? LeafProof<Fraction>(terms, box, frame).answer() == Answer::yes
                               : quick == Answer::yes;
}

}  // namespace lekalo::verify
