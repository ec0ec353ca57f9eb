// The listener of alerts beside console and journal: the code that the loop is embedded in. Boards have none, and pay
// nothing.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "firmware/console/text.hpp"

namespace fencepost::loop {

/// A profile whose alerts are heard.
template <class Base>
struct Heard : Base {
  static constexpr bool kHeard = true;
};
template <class Profile>
inline constexpr bool kIsHeard = requires {
  Profile::kHeard;
};

template <bool kHeard>
class AlertListener {
 public:
  /// The sentence has no line end.
  using Function = void (*)(void* context, const record::AlertReport& report, std::string_view sentence);

  void set(Function function, void* context) {
    function_ = function;
    context_ = context;
  }
  /// `sentence(room)` writes it and returns its length, line end included.
  template <class Sentence>
  void tell(const record::AlertReport& report, const Sentence& sentence) const {
    if (function_ == nullptr) return;
    std::array<char, console::kMaxSentence> text{};
    const std::string_view line(text.data(), sentence(std::span<char>(text)));
    function_(context_, report, line.substr(0, line.find('\r')));
  }

 private:
  Function function_ = nullptr;
  void* context_ = nullptr;
};

/// There is none, and it costs nothing.
template <>
class AlertListener<false> {
 public:
  template <class Sentence>
  static constexpr void tell(const record::AlertReport& /*report*/, const Sentence& /*sentence*/) {}
};

}  // namespace fencepost::loop
