// The models of one object as polygons of the map frame.
#pragma once

#include <span>
#include <string>

#include "firmware/recon/object.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

/// 64 vertices, the circle's area. Map frame.
ModelResult cylinder_model(const recon::ObjectCore& object);
ModelResult cylinder_paper_model(const recon::ObjectCore& object);
ModelResult clip_model(const recon::ObjectCore& object, std::span<const recon::Vec2> vertices);

/// The convex hull of a sheaf's posts; `name` is sheaf or sheaf_paper.
ModelResult sheaf_model(const recon::ObjectCore& object, std::string name, std::span<const recon::Vec2> hull,
                        recon::SheafRefusal refusal);

/// Outline of the solid cells, holes included.
ModelResult carve_model(const recon::ObjectCore& object, const recon::GridPlacement& placement, std::size_t cells,
                        std::span<const std::uint32_t> words);

}  // namespace fencepost::host
