// The measured programs: each does the same workload, in its own way.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tests/bench/workload.hpp"

namespace fencepost::bench {

/// The kind of the result, and so what it is compared with.
enum class Kind {
  kPolygon,  ///< the exact polygon of all views
  kGrid,     ///< solid cells
  kLimit     ///< nothing: what memory alone costs
};

struct Contender {
  std::string name;
  Kind kind = Kind::kPolygon;
  std::size_t cells = 0;                         ///< of a grid's side
  std::function<void()> run;                     ///< all views of all objects, from a solid arena
  std::function<std::vector<double>()> areas{};  ///< of each object, as the last run left it, m^2
  bool single_views = false;                     ///< each view cuts a solid arena: the rest says nothing
};

using Workload = std::vector<Views>;

// The robot's kernels. `workload` outlives what is made of it, here and below.
Contender our_clip(const Workload& workload);
/// Views one after the other: rows that are empty need no more work.
Contender our_carving(const Workload& workload, std::size_t cells);
/// Each view cuts a solid grid.
Contender our_dense_carving(const Workload& workload, std::size_t cells);
/// Clip and grid as one model, the grid placed anew around the rest, as profile `full` does.
Contender our_model(const Workload& workload);

/// The textbook's cut on the robot's floats: two arrays, each vertex copied in each cut.
Contender sutherland_hodgman(const Workload& workload);

/// Reads and writes each word of a grid of bits once for each view.
Contender limit(const Workload& workload, std::size_t cells);

Contender geos(const Workload& workload);
Contender opencv(const Workload& workload, std::size_t cells);
Contender clipper(const Workload& workload);
Contender boost_geometry(const Workload& workload);
Contender cgal(const Workload& workload);

}  // namespace fencepost::bench
