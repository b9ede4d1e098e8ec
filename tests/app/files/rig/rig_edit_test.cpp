// SPDX-License-Identifier: Apache-2.0
#include "app/files/rig/rig_edit.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/files/rig/rig_file.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::files {
namespace {

const std::string kCommentedRig = R"(# our machine
[ball]
centre = [120, 60, 430]          # by tape
radius = 50

[[camera]]                       # the colour one
name = "A"
width = 800
height = 600
[camera.intrinsics]
fx = 4000
fy = 4000
cx = 399.5
cy = 299.5
[camera.pose]                    # from the drawing
position = [120, -540, 430]
rotation = [1, 0, 0,  0, 0, -1,  0, 1, 0]

# not calibrated
[[camera]]
name = "B"
width = 800
height = 600
[camera.outline]
centre = [402.5, 297.1]          # by eye
radius = 264.8
distance = 11.5
rotation = [90, 0, 0]
)";

const optics::Mat3 kTurned = optics::rotation({10, 20, 30});

Result<std::string> aligned(const CameraAlignment& camera) {
  return aligned_rig(kCommentedRig, "rig.toml", ".", {std::nullopt, {camera}});
}

optics::RigCamera camera(const std::string& text, std::size_t n) {
  const auto rig = parse_rig(text, "rig.toml", ".");
  EXPECT_TRUE(rig) << rig.error().message << "\n" << text;
  return rig ? rig->cameras[n] : optics::RigCamera{};
}

TEST(RigEdit, ChangesAnOutlineAndKeepsTheRest) {
  const auto text = aligned({.camera = "B",
                             .outline = optics::Outline{{400, 300}, 260.25, 259.5, 12},
                             .registration = kTurned});
  ASSERT_TRUE(text) << text.error().message;
  const optics::RigCamera b = camera(*text, 1);
  EXPECT_EQ(b.outline->rx, 260.25);
  EXPECT_EQ(b.outline->ry, 259.5);
  EXPECT_EQ(b.outline->angle, 12);
  EXPECT_EQ(b.distance, 11.5);
  EXPECT_NEAR(b.registration.row0.y, kTurned.row0.y, 1e-9);
  for (const char* kept : {"# our machine", "# by tape", "# the colour one", "# from the drawing",
                           "# not calibrated", "# by eye"}) {
    EXPECT_NE(text->find(kept), std::string::npos) << kept << "\n" << *text;
  }
}

TEST(RigEdit, PutsAPoseInThePlaceOfAnOutline) {
  const optics::Pose pose{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {120, -500, 430}};
  const optics::Intrinsics lens{800, 600, 3000, 3000, 399.5, 299.5, {}, {}};
  const auto text = aligned({.camera = "B", .pose = pose, .intrinsics = lens});
  ASSERT_TRUE(text) << text.error().message;
  const optics::RigCamera b = camera(*text, 1);
  EXPECT_FALSE(b.outline);
  EXPECT_EQ(b.pose->position.y, -500);
  EXPECT_EQ(b.intrinsics->fx, 3000);
}

TEST(RigEdit, PutsAnOutlineInThePlaceOfAPose) {
  const auto text = aligned({.camera = "A",
                             .outline = optics::Outline{{400, 300}, 280, 280, 0},
                             .registration = kTurned});
  ASSERT_TRUE(text) << text.error().message;
  const optics::RigCamera a = camera(*text, 0);
  EXPECT_FALSE(a.pose);
  EXPECT_EQ(a.outline->rx, 280);
}

TEST(RigEdit, RegistersACamera) {
  std::string unregistered = kCommentedRig;
  unregistered.replace(unregistered.find("rotation = [90, 0, 0]"), 21, "registered = false");
  EXPECT_FALSE(camera(unregistered, 1).is_registered);
  const optics::Outline limb{{400, 300}, 260.25, 259.5, 12};
  const auto seen = aligned_rig(unregistered, "rig.toml", ".",
                                {std::nullopt, {{.camera = "B", .outline = limb}}});
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_FALSE(camera(*seen, 1).is_registered) << "its outline tells nothing";
  const auto registered =
      aligned_rig(unregistered, "rig.toml", ".",
                  {std::nullopt, {{.camera = "B", .outline = limb, .registration = kTurned}}});
  ASSERT_TRUE(registered) << registered.error().message;
  EXPECT_TRUE(camera(*registered, 1).is_registered);
  EXPECT_EQ(registered->find("registered"), std::string::npos) << *registered;
}

TEST(RigEdit, MovesTheBall) {
  const auto text = aligned_rig(kCommentedRig, "rig.toml", ".", {optics::Vec3{121.5, 60, 430}, {}});
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_NE(text->find("centre = [121.5, 60, 430]          # by tape"), std::string::npos);
}

TEST(RigEdit, RefusesWhatItCannotChange) {
  EXPECT_FALSE(aligned({.camera = "C", .registration = kTurned}));
  // This is a registration without an outline to belong to.
  EXPECT_FALSE(aligned({.camera = "A", .registration = kTurned}));
  EXPECT_FALSE(aligned_rig("[[camera]]\nname = 3\n", "rig.toml", ".", {}));
}

/// The camera's table has no header, so that its end in the text is unknown: `model` would be
/// removed with it.
TEST(RigEdit, RefusesToLoseAKeyAfterDottedOnes) {
  const std::string dotted = R"([[camera]]
name = "A"
width = 800
height = 600
outline.centre = [402.5, 297.1]
outline.radius = 264.8
model = "paper"
[camera.intrinsics]
fx = 4000
fy = 4000
cx = 399.5
cy = 299.5
)";
  const optics::Pose pose{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {0, -12, 0}};
  const auto text =
      aligned_rig(dotted, "rig.toml", ".", {std::nullopt, {{.camera = "A", .pose = pose}}});
  ASSERT_FALSE(text) << *text;
  EXPECT_EQ(text.error().message,
            "rig.toml: the change would make camera[0].model wrong; write each table that changes "
            "with a header of its own");
}

TEST(RigEdit, WritesTheFileItReadAndOnlyThen) {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "rig.toml";
  std::ofstream(file) << kCommentedRig;
  EXPECT_FALSE(write_aligned_rig(file, {std::nullopt, {{.camera = "C"}}}, file));
  const RigAlignment turned{std::nullopt, {{.camera = "B", .registration = kTurned}}};
  const auto written = write_aligned_rig(file, turned, file);
  ASSERT_TRUE(written) << written.error().message;
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_NEAR(camera(text.str(), 1).registration.row0.y, kTurned.row0.y, 1e-9);
}

}  // namespace
}  // namespace orbwatch::app::files
