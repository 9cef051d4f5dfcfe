#pragma once

// What tools/mutants.py writes into its copy of src/verify: every place asks whether its mutant is chosen,
// and does then what the mutant does. Operators stand for the ones they replace with the same precedence, so
// that nothing but a token has to be known of the code:
//
//   a < b        a < Relation<K>{} < b      K: <= instead, K + 1: the contrary
//   a == b       a == Relation<K>{} == b    K: the contrary
//   a && b       a && Right<K>{} | b        K: b counts as true
//                a | Left<K>{} && b         K: a counts as true
//   a || b       a || Right<K>{} & b        K: b counts as false; and a & Left<K>{} || b
//   std::min     least<K>                   K: std::max
//   3            number<K>(3)               K: 4; 2.5 becomes 5.0, and 0.0 1.0

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <type_traits>
#include <utility>

namespace lekalo::mutants {

extern unsigned char state[];  ///< of each mutant: 0 sleeps, 1 chosen, 2 to be noted when it is asked
bool asked(int mutant);        ///< of one whose state is not 0

constexpr bool on(int mutant) { return !std::is_constant_evaluated() && state[mutant] != 0 && asked(mutant); }

template <int K>
struct Relation {};
template <int K, class A>
struct Half {
  A&& a;
};
#define LEKALO_HALF(op)                                  \
  template <int K, class A>                              \
  constexpr Half<K, A> operator op(A&& a, Relation<K>) { \
    return {std::forward<A>(a)};                         \
  }
LEKALO_HALF(<)
LEKALO_HALF(<=)
LEKALO_HALF(>)
LEKALO_HALF(>=)
LEKALO_HALF(==)
LEKALO_HALF(!=)
#undef LEKALO_HALF

// Types with one operator alone get the other by exchanging the sides.
#define LEKALO_RELATION(op, neighbour, mirrored)              \
  template <int K, class A, class B>                          \
  constexpr bool operator op(Half<K, A> half, B&& b) {        \
    const bool truth = std::forward<A>(half.a) op b;          \
    if (on(K)) {                                              \
      if constexpr (requires { bool(half.a neighbour b); }) { \
        return bool(half.a neighbour b);                      \
      } else {                                                \
        return !(b mirrored half.a);                          \
      }                                                       \
    }                                                         \
    return on(K + 1) ? !truth : truth;                        \
  }
LEKALO_RELATION(<, <=, <)
LEKALO_RELATION(<=, <, <=)
LEKALO_RELATION(>, >=, >)
LEKALO_RELATION(>=, >, >=)
#undef LEKALO_RELATION
// An optional would rather compare its value with the half.
#define LEKALO_RELATION(op)                                                \
  template <int K, class A, class B>                                       \
  constexpr bool operator op(Half<K, A> half, B&& b) {                     \
    const bool truth = std::forward<A>(half.a) op b;                       \
    return on(K) ? !truth : truth;                                         \
  }                                                                        \
  template <int K, class A, class T>                                       \
  constexpr bool operator op(Half<K, A> half, const std::optional<T>& b) { \
    const bool truth = std::forward<A>(half.a) op b;                       \
    return on(K) ? !truth : truth;                                         \
  }
LEKALO_RELATION(==)
LEKALO_RELATION(!=)
#undef LEKALO_RELATION

template <int K>
struct Right {};
template <int K>
struct Left {};
template <int K, class B>
constexpr bool operator|(Right<K>, B&& b) {
  return on(K) || static_cast<bool>(b);
}
template <int K, class B>
constexpr bool operator&(Right<K>, B&& b) {
  return !on(K) && static_cast<bool>(b);
}
template <int K, class A>
constexpr bool operator|(A&& a, Left<K>) {
  return on(K) || static_cast<bool>(a);
}
template <int K, class A>
constexpr bool operator&(A&& a, Left<K>) {
  return !on(K) && static_cast<bool>(a);
}

template <int K, class T>
constexpr const T& least(const T& a, const T& b) {
  return on(K) ? std::max(a, b) : std::min(a, b);
}
template <int K, class T>
constexpr T least(std::initializer_list<T> all) {
  return on(K) ? std::max(all) : std::min(all);
}
template <int K, class T>
constexpr const T& greatest(const T& a, const T& b) {
  return on(K) ? std::min(a, b) : std::max(a, b);
}
template <int K, class T>
constexpr T greatest(std::initializer_list<T> all) {
  return on(K) ? std::min(all) : std::max(all);
}

template <int K, class T>
constexpr T number(T value) {
  if (!on(K)) return value;
  if constexpr (std::is_integral_v<T>) return static_cast<T>(value + 1);
  return value == 0 ? T(1) : 2 * value;
}

}  // namespace lekalo::mutants
