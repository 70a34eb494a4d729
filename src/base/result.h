// The result of a call whose failure is normal: a value, or one line with the reason.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace understudy {

// The reason of a failure: one line, without a full stop.
struct Error {
  std::string why;
};

// The value of a call that returns nothing.
struct Done {};

// A T or an Error. The default is T{}, which for Result<> means success.
template <class T = Done>
class [[nodiscard]] Result {
 public:
  Result() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): allows `return value;`
  Result(T value) : is_(std::in_place_index<0>, std::move(value)) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  Result(Error error) : is_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return is_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // Require ok().
  const T& operator*() const { return *std::get_if<0>(&is_); }
  T& operator*() { return *std::get_if<0>(&is_); }
  const T* operator->() const { return std::get_if<0>(&is_); }
  T* operator->() { return std::get_if<0>(&is_); }

  // Returns "" if ok().
  std::string why() const { return ok() ? "" : std::get_if<1>(&is_)->why; }
  // Requires !ok(). Returns the error, for example for another Result.
  const Error& error() const { return *std::get_if<1>(&is_); }

 private:
  std::variant<T, Error> is_{};
};

}  // namespace understudy
