#include "firmware/console/link_words.hpp"

#include "firmware/console/sentence.hpp"

namespace fencepost::console {

using sensor::LinkState;

LinkWords plain_link_words(std::string_view name, LinkState state) {
  LinkWords words{name, name, "", ""};
  switch (state) {
    case LinkState::kAbsent: words.detail = "not there"; break;
    case LinkState::kSilent:
      words.detail = "no answer";
      words.remedy = "nothing answers; check its power, the wires (TX to RX) and the baud";
      break;
    case LinkState::kUnready:
      words.detail = "not ready";
      words.remedy = "it starts, is not taught colours, or is another model";
      break;
    case LinkState::kEmpty: words.detail = "nothing seen"; break;
    case LinkState::kOk: break;
  }
  return words;
}

std::size_t describe_link(LinkState state, std::string_view name, std::string_view remedy, std::span<char> out) {
  Sentence s(out);
  s.put(name);
  switch (state) {
    case LinkState::kAbsent: s.put(" is absent; going on without it until it is back"); break;
    case LinkState::kSilent: s.put(" is silent"); break;
    case LinkState::kUnready: s.put(" is unready"); break;
    case LinkState::kEmpty: s.put(" works and sees nothing"); break;
    case LinkState::kOk: s.put(" works"); break;
  }
  if (!remedy.empty()) s.put(": ").put(remedy);
  return s.end();
}

}  // namespace fencepost::console
