#include "host/evaluate/following.hpp"

#include <set>

namespace fencepost::host {

void Following::add(const BlobOwners& owners, std::span<const PlacedSighting> sightings) {
  std::set<std::size_t> seen;
  for (const std::optional<std::size_t>& owner : owners) {
    if (owner) seen.insert(*owner);
  }
  for (const std::size_t truth : seen) ++visible_[truth];
  for (const PlacedSighting& sighting : sightings) {
    Track& track = tracks_[sighting.id];
    const std::optional<std::size_t> owner = owners.at(sighting.blob);
    if (!owner) continue;
    if (track.last && track.last != owner) ++track.swaps;
    track.last = owner;
    ++track.sightings[*owner];
  }
}

void Following::forget_deleted(const std::function<bool(std::uint32_t)>& in_map) {
  if (tracks_.size() < kManyObjects) return;
  std::erase_if(tracks_, [&](const auto& track) {
    if (in_map(track.first)) return false;
    swaps_of_deleted_ += track.second.swaps;
    return true;
  });
}

std::uint64_t Following::visible(std::size_t truth) const {
  const auto found = visible_.find(truth);
  return found == visible_.end() ? 0 : found->second;
}

std::uint64_t Following::swaps(std::uint32_t id) const {
  const auto track = tracks_.find(id);
  return track == tracks_.end() ? 0 : track->second.swaps;
}

std::uint64_t Following::swaps() const {
  std::uint64_t sum = swaps_of_deleted_;
  for (const auto& [id, track] : tracks_) sum += track.swaps;
  return sum;
}

std::optional<std::size_t> Following::follows(std::uint32_t id) const {
  const auto track = tracks_.find(id);
  if (track == tracks_.end()) return std::nullopt;
  std::optional<std::size_t> most;
  std::uint64_t times = 0;
  for (const auto& [truth, count] : track->second.sightings) {
    if (count <= times) continue;
    most = truth;
    times = count;
  }
  return most;
}

}  // namespace fencepost::host
