// SPDX-License-Identifier: Apache-2.0
#include "app/machine/trigger_agreement.h"

#include <gtest/gtest.h>

#include "tests/app/machine/moments.h"

namespace orbwatch::app::machine {
namespace {

using tests::at_ms;

/// A controller that triggers every 33 ms and sends its state every 10 ms; its count begins 100
/// above ours. Two sets after set `lost` is the edge that we did not see.
int slips_of(int sets, int lost, int first_count = 100) {
  StateTrack track(std::chrono::seconds(1));
  TriggerAgreement agreement;
  int slips = 0, own = 0;
  int next_state = 0;
  for (int n = 1; n <= sets; ++n) {
    const int exposure = 1000 + 33 * n;
    // As in the frame path, the states after the exposure come later.
    for (; 1000 + 10 * next_state <= exposure + 2; ++next_state) {
      const int ms = 1000 + 10 * next_state;
      TimedState state{at_ms(ms), {}, {}, {0, 0, -1}};
      state.values.trigger_count = first_count == 0 ? 0 : first_count + (ms - 1000) / 33;
      track.add(state);
    }
    if (n == lost) continue;
    slips += agreement.slips(track, static_cast<std::uint64_t>(++own), at_ms(exposure));
  }
  return slips;
}

TEST(TriggerAgreement, EqualCountsNeverSlip) { EXPECT_EQ(slips_of(3000, 0), 0); }

TEST(TriggerAgreement, ALostEdgeIsNoticedOnce) { EXPECT_EQ(slips_of(300, 150), 1); }

TEST(TriggerAgreement, AControllerThatCountsNoneIsNotJudged) {
  EXPECT_EQ(slips_of(300, 150, 0), 0);
}

}  // namespace
}  // namespace orbwatch::app::machine
