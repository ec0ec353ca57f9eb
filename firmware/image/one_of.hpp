// Room for one object of several types, of which there is always one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

namespace fencepost::image {

/// std::variant without its exceptions. What was there is not destroyed but overwritten: none of the types would
/// notice.
template <class... Types>
class OneOf {
  static_assert((std::is_trivially_destructible_v<Types> && ...));

 public:
  /// Constructs an object in place of the one that is held.
  template <class Type, class... Arguments>
  Type& hold(Arguments&&... arguments) {
    index_ = kIndex<Type>;
    return *std::construct_at(static_cast<Type*>(static_cast<void*>(bytes_.data())),
                              std::forward<Arguments>(arguments)...);
  }

  /// Returns `use(object)` of the object that is held.
  template <class Use>
  decltype(auto) visit(Use&& use) {
    return visit_from<0, Types...>(bytes_.data(), use);
  }
  template <class Use>
  decltype(auto) visit(Use&& use) const {
    return visit_from<0, const Types...>(bytes_.data(), use);
  }

 private:
  template <class Type>
  static constexpr std::uint8_t kIndex = [] {
    constexpr std::array<bool, sizeof...(Types)> kSame = {std::is_same_v<Type, Types>...};
    return static_cast<std::uint8_t>(std::find(kSame.begin(), kSame.end(), true) - kSame.begin());
  }();

  template <std::uint8_t kFirst, class First, class... Rest, class Bytes, class Use>
  decltype(auto) visit_from(Bytes* bytes, Use& use) const {
    if constexpr (sizeof...(Rest) > 0) {
      if (index_ != kFirst) return visit_from<kFirst + 1, Rest...>(bytes, use);
    }
    using Void = std::conditional_t<std::is_const_v<First>, const void, void>;
    return use(*static_cast<First*>(static_cast<Void*>(bytes)));
  }

  alignas(Types...) std::array<std::byte, std::max({sizeof(Types)...})> bytes_{};
  std::uint8_t index_ = 0;
};

}  // namespace fencepost::image
