// What a call came to where failing is an everyday outcome: a value, or one line that says why not.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace understudy {

// Why there is no value: one line, without a full stop.
struct Error {
  std::string why;
};

// The value of a call that only does something.
struct Done {};

// A T, or an Error. By default T{}: of Result<> that is success.
template <class T = Done>
class [[nodiscard]] Result {
 public:
  Result() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): `return value;` is the point of it
  Result(T value) : is_(std::in_place_index<0>, std::move(value)) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  Result(Error error) : is_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return is_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // Only where ok().
  const T& operator*() const { return *std::get_if<0>(&is_); }
  T& operator*() { return *std::get_if<0>(&is_); }
  const T* operator->() const { return std::get_if<0>(&is_); }
  T* operator->() { return std::get_if<0>(&is_); }

  // "" where ok().
  std::string why() const { return ok() ? "" : std::get_if<1>(&is_)->why; }
  // Only where not ok(): to hand on as another Result.
  const Error& error() const { return *std::get_if<1>(&is_); }

 private:
  std::variant<T, Error> is_{};
};

}  // namespace understudy
