// The words between the stage and the threads on it, over a Unix socket that keeps messages whole.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>

namespace fencepost::stage {

/// The folder of the stage, in the environment of each program on it.
inline constexpr const char* kVariable = "FENCEPOST_STAGE";
/// A file there that every program on the stage maps: a Board.
inline constexpr const char* kBoard = "/board";
/// A socket there: each thread that waits has a connection of its own.
inline constexpr const char* kSocket = "/socket";

inline constexpr std::int64_t kNever = INT64_MAX;  ///< ns: a wait without a deadline
inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

struct Board {
  std::atomic<std::int64_t> now_ns;
  std::atomic<std::uint64_t> written;  ///< how often something was written to a terminal
};

enum class Word : std::int32_t {
  kWait,   ///< thread: it waits for its descriptors or the deadline
  kAwake,  ///< thread: the wait is over
  kIdle,   ///< thread: none of its descriptors is ready
  kCheck,  ///< stage: is one of your descriptors ready?
  kTime,   ///< stage: the deadline has come
};

struct Message {
  Word word = Word::kWait;
  std::uint32_t wait = 0;             ///< number of the thread's wait: an answer to an earlier one is void
  std::int64_t deadline_ns = kNever;  ///< of kWait
  pid_t process = 0;
  pid_t thread = 0;
};

}  // namespace fencepost::stage
