// Private members of decoders, for tests that have to see a control state. An explicit instantiation may name what it
// has no access to ([temp.spec]), so the decoders need no hook.
#pragma once

namespace fencepost::test {

template <class Tag, auto Member>
struct Reveal {
  friend constexpr auto revealed(Tag) { return Member; }
};

}  // namespace fencepost::test

// NOLINTBEGIN: a declaration cannot be made of a name otherwise.
#define FENCEPOST_REVEAL(Tag, member)    \
  struct Tag {                           \
    friend constexpr auto revealed(Tag); \
  };                                     \
  template struct Reveal<Tag, member>
// NOLINTEND
