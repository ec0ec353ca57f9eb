// The result of opening a device: the device, or a sentence for its user.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "hal/base/check.hpp"

namespace fencepost::linux {

/// A sentence: the failure, its place and a remedy; without a full stop, as messages have it.
struct Problem {
  std::string sentence;
};

/// "cannot WHAT WHERE: reason of the system; REMEDY".
Problem failure(std::string_view what, std::string_view where, int error, std::string_view remedy);

template <class T>
class [[nodiscard]] Opened {
 public:
  Opened(T value) : held_(std::move(value)) {}            // NOLINT(google-explicit-constructor)
  Opened(Problem problem) : held_(std::move(problem)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return std::holds_alternative<T>(held_); }
  explicit operator bool() const { return ok(); }

  /// The device; asking for it on failure is a bug and traps. A caller that keeps it moves it out of here.
  [[nodiscard]] T& value() {
    FENCEPOST_CHECK(ok());
    return *std::get_if<T>(&held_);
  }
  T& operator*() { return value(); }
  T* operator->() { return &value(); }

  /// The sentence; asking for it on success is a bug and traps.
  [[nodiscard]] const std::string& problem() const {
    FENCEPOST_CHECK(!ok());
    return std::get_if<Problem>(&held_)->sentence;
  }

 private:
  std::variant<T, Problem> held_;
};

}  // namespace fencepost::linux
