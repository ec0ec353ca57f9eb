// A value or the reason why there is none. No exceptions below host/.
#pragma once

#include <type_traits>

#include "hal/base/check.hpp"

namespace fencepost::base {

/// Why a bus or a sensor gave nothing. `kNotReady` is normal; the caller counts the others.
enum class Error : unsigned char {
  kNotReady,  ///< nothing yet: ask again
  kBadInput,  ///< bytes arrived that cannot be decoded: dropped
  kFull,      ///< no room: the caller keeps the item or counts its loss
  kGone,      ///< the device is not there any more
  kRefused,   ///< the device or the system said no
};

/// Holds a T, or an E that says why not. On error there is no T: where both are plain data nothing is written for it.
template <class T, class E = Error>
class [[nodiscard]] Result {
 public:
  constexpr Result(const T& value) : either_(value), ok_(true) {}  // NOLINT(google-explicit-constructor)
  constexpr Result(E error) : either_(error), ok_(false) {}        // NOLINT(google-explicit-constructor)

  [[nodiscard]] constexpr bool ok() const { return ok_; }
  constexpr explicit operator bool() const { return ok_; }

  /// The value; asking for it on error is a bug and traps.
  [[nodiscard]] constexpr const T& value() const {
    FENCEPOST_CHECK(ok_);
    return either_.value;
  }
  [[nodiscard]] constexpr const T& operator*() const { return value(); }
  [[nodiscard]] constexpr const T* operator->() const { return &value(); }

  /// The reason; asking for it on success is a bug and traps.
  [[nodiscard]] constexpr E error() const {
    FENCEPOST_CHECK(!ok_);
    return either_.error;
  }

 private:
  union One {
    constexpr explicit One(const T& one) : value(one) {}
    constexpr explicit One(E reason) : error(reason) {}
    T value;
    E error;
  };
  struct Both {
    constexpr explicit Both(const T& one) : value(one) {}
    constexpr explicit Both(E reason) : error(reason) {}
    T value{};
    E error{};
  };
  static constexpr bool kPlain = std::is_trivially_copyable_v<T> && std::is_trivially_copyable_v<E>;

  std::conditional_t<kPlain, One, Both> either_;
  bool ok_;
};

}  // namespace fencepost::base
