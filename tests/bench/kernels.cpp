// The robot's own kernels, and the limit of memory.
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "firmware/recon/models/clip.hpp"
#include "host/geometry/rings.hpp"
#include "host/models/carve.hpp"
#include "tests/bench/contender.hpp"

namespace fencepost::bench {
namespace {

using Clip = recon::ConvexClip<192>;

struct Sides {
  recon::HalfPlane left;
  recon::HalfPlane right;
};
std::vector<std::vector<Sides>> sides_of(const Workload& workload) {
  std::vector<std::vector<Sides>> all;
  for (const Views& object : workload) {
    auto& sides = all.emplace_back();
    for (const View& view : object.views) sides.push_back({left_side(view), right_side(view)});
  }
  return all;
}

/// Sutherland and Hodgman's cut, as textbooks have it: each edge in turn, its first point if that is inside, and where
/// it crosses. The numbers are the clip's; its slivers, room and simplification are left out.
class PlainCut {
 public:
  void start() {
    vertices_ = &one_;
    other_ = &two_;
    size_ = 0;
    for (const host::Point& corner : arena()) {
      one_[size_++] = {static_cast<float>(corner.x), static_cast<float>(corner.y)};
    }
  }
  void cut(const recon::HalfPlane& half_plane) {
    const auto outside_by = [&](const recon::Vec2& v) { return half_plane.normal.dot(v) - half_plane.bound; };
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const recon::Vec2 here = (*vertices_)[i];
      const recon::Vec2 next = (*vertices_)[i + 1 == size_ ? 0 : i + 1];
      const float d_here = outside_by(here);
      const float d_next = outside_by(next);
      if (d_here <= 0) (*other_)[count++] = here;
      if ((d_here <= 0) != (d_next <= 0)) (*other_)[count++] = here + d_here / (d_here - d_next) * (next - here);
    }
    std::swap(vertices_, other_);
    size_ = count;
  }
  [[nodiscard]] std::span<const recon::Vec2> vertices() const { return {vertices_->data(), size_}; }

 private:
  using Vertices = std::array<recon::Vec2, 4 + 2 * kViews + 2>;  // a cut adds one; rounding might add another
  Vertices one_;
  Vertices two_;
  Vertices* vertices_ = &one_;
  Vertices* other_ = &two_;
  std::size_t size_ = 0;
};

double area_of_vertices(std::span<const recon::Vec2> vertices) {
  host::LinearRing ring;
  for (const recon::Vec2& v : vertices) {
    ring.push_back({static_cast<double>(v.x()), static_cast<double>(v.y())});
  }
  return host::area({ring, {}});
}
double area_of(const Clip& clip) { return area_of_vertices(clip.vertices()); }
double area_of(const PlainCut& cut) { return area_of_vertices(cut.vertices()); }

template <std::size_t N>
double area_of(const recon::CarveGrid<N>& grid) {
  int solid = 0;
  for (const std::uint32_t word : grid.words()) solid += std::popcount(word);
  const auto cell = static_cast<double>(grid.placement().cell);
  return solid * cell * cell;
}

/// One state an object, and its update for each view.
template <class State>
struct Kernel {
  explicit Kernel(const Workload& workload) : sides(sides_of(workload)), states(workload.size()) {}

  std::vector<std::vector<Sides>> sides;
  std::vector<State> states;
};

template <class State>
std::function<std::vector<double>()> areas_of(std::shared_ptr<Kernel<State>> kernel) {
  return [kernel] {
    std::vector<double> areas;
    for (const State& state : kernel->states) areas.push_back(area_of(state));
    return areas;
  };
}

template <class State, class Cut>
Contender in_turn(std::string name, Kind kind, std::size_t cells, const Workload& workload, Cut cut) {
  const auto kernel = std::make_shared<Kernel<State>>(workload);
  const auto run = [kernel, cut] {
    for (std::size_t o = 0; o < kernel->states.size(); ++o) {
      State& state = kernel->states[o];
      state.start();
      for (const Sides& sides : kernel->sides[o]) cut(state, sides);
    }
  };
  return {std::move(name), kind, cells, run, areas_of(kernel)};
}

template <std::size_t N>
Contender carving(const Workload& workload) {
  return in_turn<recon::CarveGrid<N>>("carve_half_plane", Kind::kGrid, N, workload,
                                      [](recon::CarveGrid<N>& grid, const Sides& sides) {
                                        grid.carve(sides.left);
                                        grid.carve(sides.right);
                                      });
}

template <std::size_t N>
Contender dense_carving(const Workload& workload) {
  Contender contender = in_turn<recon::CarveGrid<N>>("carve_half_plane, each view a solid grid", Kind::kGrid, N,
                                                     workload, [](recon::CarveGrid<N>& grid, const Sides& sides) {
                                                       grid.start();
                                                       grid.carve(sides.left);
                                                       grid.carve(sides.right);
                                                     });
  contender.single_views = true;
  return contender;
}

struct Model {
  void start() {
    clip.start();
    grid.start();
  }
  Clip clip;
  recon::CarveGrid<128> grid;
};
double area_of(const Model& model) { return area_of(model.grid); }

// A loop so short takes twice its time where it lies badly.
template <std::size_t kWords>
[[gnu::noinline, gnu::aligned(64)]] void touch(std::uint32_t* words) {
#pragma GCC unroll 8
  for (std::size_t i = 0; i < kWords; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) words[i + k] ^= 0x55555555U;
  }
}

template <std::size_t N>
Contender touch_words(const Workload& workload) {
  struct Words {
    alignas(64) std::array<std::uint32_t, N * N / 32> all{};
  };
  const auto grids = std::make_shared<std::vector<Words>>(workload.size());
  const auto run = [grids] {
    for (Words& words : *grids) {
      for (std::size_t v = 0; v < kViews; ++v) {
        touch<N * N / 32>(words.all.data());
        asm volatile("" : : "r"(words.all.data()) : "memory");  // or two views would be joined
      }
    }
  };
  return {"touch every word once", Kind::kLimit, N, run};
}

template <class Make64, class Make128, class Make256>
Contender for_cells(std::size_t cells, Make64 make64, Make128 make128, Make256 make256) {
  return cells == 64 ? make64() : cells == 128 ? make128() : make256();
}

}  // namespace

Contender our_clip(const Workload& workload) {
  return in_turn<Clip>("clip_convex", Kind::kPolygon, 0, workload, [](Clip& clip, const Sides& sides) {
    clip.cut(sides.left);
    clip.cut(sides.right);
  });
}

Contender sutherland_hodgman(const Workload& workload) {
  return in_turn<PlainCut>("Sutherland-Hodgman, plain", Kind::kPolygon, 0, workload,
                           [](PlainCut& cut, const Sides& sides) {
                             cut.cut(sides.left);
                             cut.cut(sides.right);
                           });
}

Contender our_carving(const Workload& workload, std::size_t cells) {
  return for_cells(
      cells, [&] { return carving<64>(workload); }, [&] { return carving<128>(workload); },
      [&] { return carving<256>(workload); });
}

Contender our_dense_carving(const Workload& workload, std::size_t cells) {
  return for_cells(
      cells, [&] { return dense_carving<64>(workload); }, [&] { return dense_carving<128>(workload); },
      [&] { return dense_carving<256>(workload); });
}

Contender our_model(const Workload& workload) {
  return in_turn<Model>("clip and grid, placed anew", Kind::kGrid, 128, workload, [](Model& model, const Sides& sides) {
    for (const recon::HalfPlane* side : {&sides.left, &sides.right}) {
      model.clip.cut(*side);
      model.grid.carve(*side);
    }
    model.grid.refine(model.clip.vertices());
  });
}

Contender limit(const Workload& workload, std::size_t cells) {
  return for_cells(
      cells, [&] { return touch_words<64>(workload); }, [&] { return touch_words<128>(workload); },
      [&] { return touch_words<256>(workload); });
}

}  // namespace fencepost::bench
