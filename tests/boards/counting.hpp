// Instructions and stack of an image, counted by a plugin of the emulator.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "host/scene/scene.hpp"
#include "tests/boards/emulator.hpp"
#include "tests/boards/scene_stream.hpp"

namespace fencepost::test {

class Bench;

struct StageCount {
  std::uint64_t calls = 0;
  std::uint64_t sum = 0;    ///< instructions, interrupts in between included
  std::uint64_t worst = 0;  ///< of one call
};

/// By stage name; "all": everything the core did, "stack": sum is the high-water mark in bytes.
using Counts = std::map<std::string, StageCount>;

/// A name for the tables and a part of the function's demangled name, each.
using Stages = std::vector<std::pair<std::string, std::string>>;

/// The stages of all images. "input" is all that a frame sets in motion. Within it, "predict" is where objects should
/// be, "see" the blobs' ends, "pose" the pose correction. The others within it are "models" and "hybrid", "digest",
/// "guard", "alerts". Beside it are "line", the console and its records, and the loop's whole "turn". `more` are the
/// board's own.
Stages stages_of_a_loop(const Stages& more = {});

/// And those of profiles that see the floor: "floor" of the frames that are looked at, "sectors" and "ways" once a
/// question.
Stages with_floor(Stages more);

/// Of a symbol, in hexadecimal digits. Throws std::runtime_error where the image has none of that name.
std::string address_of(const std::string& elf, const std::string& symbol);
/// The emulator's arguments. Throws std::runtime_error where a function is not in the image, or nothing calls it.
std::vector<std::string> counting_arguments(const std::string& elf, const Stages& stages, const std::string& out);
Counts read_counts(const std::string& file);
/// The row's number in firmware/image/sizes.csv.
std::uint64_t committed(const std::string& image, const std::string& column);
/// Is correct.pose on while it is counted?
enum class PoseCorrected : bool { kNo, kYes };

/// A table full of objects, counted.
struct FullTable {
  std::string image;  ///< its preset, and its rows in the tables
  Stages more;        ///< of this board alone
  host::Scene scene;
  std::size_t objects;
  double least;                    ///< frames that are counted of those that are shown
  std::string file = "fencepost";  ///< in the preset's folder
};

// GoogleTest expectations.
/// The board is ready, its pose is corrected or not, and its camera and colours are being configured.
void expect_ready_to_count(Bench& bench, const SceneStream& stream, PoseCorrected corrected);
/// Plays the scene; all objects are in the table at its end.
void expect_full_table(Bench& bench, const SceneStream& stream, std::size_t objects);
/// All of it where the emulator counts: `board` is started with counting_arguments().
void expect_full_table_as_committed(const FullTable& table, PoseCorrected corrected,
                                    const std::function<BoardUnderTest(const std::vector<std::string>&)>& board);

/// Prints the stages. Expects more than `least` frames: calls of the stage "digest". Of each stage it expects no more
/// instructions a frame, and a call, than its row in firmware/image/stages.csv has. The stack has to be within the
/// image's row in sizes.csv, and with correct.pose off so has the whole frame ("input").
void expect_counts_as_committed(const Counts& counts, const std::string& image, PoseCorrected corrected, double least);

}  // namespace fencepost::test
