#include "host/simulate/random.hpp"

#include <cmath>

namespace fencepost::host {

namespace {

std::uint64_t splitmix64(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

constexpr std::uint64_t rotated_left(std::uint64_t value, unsigned by) { return (value << by) | (value >> (64U - by)); }

}  // namespace

Random::Random(std::uint64_t seed, Purpose purpose, std::uint64_t index) : state_{} {
  std::uint64_t mix = seed;
  mix = splitmix64(mix) ^ static_cast<std::uint64_t>(purpose);
  mix = splitmix64(mix) ^ index;
  for (std::uint64_t& word : state_) word = splitmix64(mix);
}

std::uint64_t Random::next() {
  const std::uint64_t result = rotated_left(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17U;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = rotated_left(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

bool Random::chance(double probability) { return uniform() < probability; }

std::uint64_t Random::below(std::uint64_t count) {
  // The bias of the product is below 2^-40 for the small counts used here.
  return static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
}

double Random::gaussian() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double u = 0;
  double v = 0;
  double s = 0;
  do {
    u = 2 * uniform() - 1;
    v = 2 * uniform() - 1;
    s = u * u + v * v;
  } while (s >= 1 || s == 0);
  const double factor = std::sqrt(-2 * std::log(s) / s);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

unsigned Random::poisson(double mean) {
  const double limit = std::exp(-mean);
  double product = uniform();
  unsigned count = 0;
  while (product > limit) {
    product *= uniform();
    ++count;
  }
  return count;
}

}  // namespace fencepost::host
