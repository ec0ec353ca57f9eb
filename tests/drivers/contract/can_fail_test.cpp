// The contract's cases can fail: a driver with one flaw breaks one of them, and the same driver without it none.
#include <gtest/gtest.h>

#include <string_view>

#include "tests/drivers/bench/comeback.hpp"
#include "tests/drivers/contract/contract.hpp"
#include "tests/drivers/contract/toy.hpp"

namespace fencepost::test {
namespace {

template <Flaw F>
HostileCase toy() {
  return hostile_case<ToyRig<F>, 2>("toy", {kSum8, 0, {}});
}

Kept kept(std::string_view name, const HostileCase& driver) {
  for (const ContractCase& contract : contract_cases()) {
    if (contract.name == name) return contract.run(*driver.make({}));
  }
  ADD_FAILURE() << "no case " << name;
  return {};
}

bool same(const Kept& a, const Kept& b) {
  return a.broken.empty() == b.broken.empty() && a.tries == b.tries && a.unnoticed == b.unnoticed &&
         a.longest == b.longest && a.total == b.total;
}

TEST(ContractCanFail, ASoundDriverKeepsAll) {
  const HostileCase sound = toy<Flaw::kNone>();
  for (const ContractCase& contract : contract_cases()) {
    const Kept kept = contract.run(*sound.make({}));
    EXPECT_EQ(kept.unnoticed, 0U) << contract.name;
    EXPECT_GT(kept.tries, 5U) << contract.name;
    for (const std::string& broken : kept.broken) ADD_FAILURE() << contract.name << ": " << broken;
  }
  EXPECT_EQ(measure_recovery(sound).stale, 0U);
  EXPECT_EQ(measure_recovery(sound).wrong, 0U);
  EXPECT_LT(measure_recovery(sound).power, base::milliseconds(1'000));
  EXPECT_EQ(hear_noise(sound)->samples, 0U);
}

struct Flawed {
  std::string_view breaks;
  HostileCase driver;
};

TEST(ContractCanFail, EachFlawBreaksItsCase) {
  const Flawed flaws[] = {{"calm", toy<Flaw::kSaysNoEmptiness>()},      {"garbage", toy<Flaw::kGarbageTakesTheNext>()},
                          {"cut", toy<Flaw::kDamageTakesTheNext>()},    {"flip", toy<Flaw::kIgnoresItsSum>()},
                          {"split", toy<Flaw::kForgetsBetweenPolls>()}, {"crowd", toy<Flaw::kDropsUncounted>()},
                          {"crowd", toy<Flaw::kKeepsTheFirst>()},       {"flood", toy<Flaw::kWaitsForTheImpossible>()},
                          {"flood", toy<Flaw::kTakesAllThatThereIs>()}, {"random", toy<Flaw::kTrustsBoxes>()},
                          {"lost link", toy<Flaw::kKeepsHalves>()},     {"lost link", toy<Flaw::kSaysNoLoss>()},
                          {"unready", toy<Flaw::kInventsFrames>()},     {"unready", toy<Flaw::kBabbles>()}};
  for (const Flawed& flaw : flaws) {
    EXPECT_FALSE(same(kept(flaw.breaks, toy<Flaw::kNone>()), kept(flaw.breaks, flaw.driver)))
        << flaw.breaks << ", " << &flaw - flaws;
  }
}

TEST(ContractCanFail, ADriverThatDoesNotComeBackIsFound) {
  EXPECT_GT(measure_recovery(toy<Flaw::kAsksOnce>()).power, base::milliseconds(10'000));
  EXPECT_GT(measure_recovery(toy<Flaw::kHoldsBack>()).stale, 0U);
  EXPECT_EQ(spend_day(toy<Flaw::kNone>()).stalled, sensor::LinkState::kSilent);
  EXPECT_NE(spend_day(toy<Flaw::kSaysNoSilence>()).stalled, sensor::LinkState::kSilent);
  EXPECT_GT(hear_noise(toy<Flaw::kTrustsBoxes>())->samples, 0U);
}

}  // namespace
}  // namespace fencepost::test
