// SPDX-License-Identifier: Apache-2.0
#include "app/watch/alignment_checksum.h"

#include <gtest/gtest.h>

#include "tests/app/alignment/rig_with_pose.h"

namespace orbwatch::app {
namespace {

AlignedSite aligned_site() {
  AlignedSite site;
  site.rig = tests::rig_with_pose({120, -500, 430});
  site.cameras.push_back({"a", 0, {}});
  return site;
}

CalibrationEntry accepted(const std::string& camera, int number) {
  CalibrationEntry entry;
  entry.number = number;
  entry.time = "2026-11-27T12:00:00Z";
  entry.alignment.cameras.push_back({.camera = camera});
  return entry;
}

TEST(AlignmentChecksum, ChangesWithWhatPlacesThePictureOfTheBall) {
  const std::uint32_t before = alignment_checksum(aligned_site(), 0);
  EXPECT_EQ(alignment_checksum(aligned_site(), 0), before);
  for (void (*change)(AlignedSite&) : std::initializer_list<void (*)(AlignedSite&)>{
           [](AlignedSite& s) { s.rig.ball.radius += 1e-9; },
           [](AlignedSite& s) { s.rig.ball.centre.z += 1; },
           [](AlignedSite& s) { s.rig.cameras[0].pose->position.x += 1; },
           [](AlignedSite& s) { s.rig.cameras[0].intrinsics->fx += 1; },
           [](AlignedSite& s) { s.rig.cameras[0].pose.reset(); },
           [](AlignedSite& s) {
             s.rig.cameras[0].outline = optics::Outline{{1, 2}, 3, 4, 5};
           },
           [](AlignedSite& s) { s.rig.cameras[0].is_registered = false; },
           [](AlignedSite& s) { s.cameras[0].name = "b"; },
       }) {
    AlignedSite site = aligned_site();
    change(site);
    EXPECT_NE(alignment_checksum(site, 0), before);
  }
}

TEST(AlignmentChecksum, DiffersForEachAcceptedAlignmentOfTheCamera) {
  AlignedSite site = aligned_site();
  const std::uint32_t of_rig = alignment_checksum(site, 0);
  site.alignments.push_back(accepted("b", 1));
  EXPECT_EQ(alignment_checksum(site, 0), of_rig) << "another camera's";
  site.alignments.push_back(accepted("a", 2));
  const std::uint32_t second = alignment_checksum(site, 0);
  EXPECT_NE(second, of_rig);
  site.alignments.back().number = 3;
  EXPECT_NE(alignment_checksum(site, 0), second);
}

TEST(AlignmentChecksum, DoesNotDependOnTheRoom) {
  AlignedSite site = aligned_site();
  const std::uint32_t before = alignment_checksum(site, 0);
  site.rig.scene.obstacles.push_back({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(alignment_checksum(site, 0), before);
}

}  // namespace
}  // namespace orbwatch::app
