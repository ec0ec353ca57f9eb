// A camera's session that is stepped by hand.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fencepost::test {

/// Whether the session says something at this time, 0.1 ms, which is sent.
template <class Session>
bool says(Session& session, std::int64_t t) {
  session.step({t});
  const std::size_t size = session.outbox().waiting().size();
  session.outbox().sent(size);
  return size > 0;
}

}  // namespace fencepost::test
