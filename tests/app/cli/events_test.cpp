// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/ports/recorder/events/event_summary.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"

/// Runs `orbwatch events` like a user.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;

constexpr const char* kAlarm = "20261128T090000.125Z-alarm";
constexpr const char* kLayer = "20261128T093000.000Z-layer";

class RecordedEvents : public CommandLine {
 protected:
  void SetUp() override {
    for (const char* const name : {kLayer, kAlarm}) {
      const std::filesystem::path event = path(std::string("events/") + name);
      std::filesystem::create_directories(event);
      std::ofstream(event / "event.mcap") << "recording";
      app::recorder::EventSummary summary;
      summary.trigger = name == kAlarm ? "alarm" : "layer";
      summary.text = "pool: hot_spot_width raised";
      summary.part = "Flügel 7";
      summary.pictures = {{"thermal", 321}};
      ASSERT_TRUE(app::recorder::write_summary(event, summary));
    }
  }

  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "events");
    arguments.insert(arguments.end(), {"--folder", folder.path()});
    return CommandLine::run(arguments);
  }
  bool exists(const std::string& name) const {
    return std::filesystem::exists(path("events/" + name));
  }
};

TEST_F(RecordedEvents, AreListedTheOldestFirst) {
  ASSERT_EQ(run({"list"}), 0) << said;
  EXPECT_LT(said.find(kAlarm), said.find(kLayer)) << said;
  ASSERT_EQ(run({"list", "--json"}), 0) << said;
  const auto json = parsed(said);
  ASSERT_EQ(json["events"].size(), 2U);
  EXPECT_EQ(json["events"][0]["name"], kAlarm);
  EXPECT_EQ(json["events"][0]["pinned"], false);
  ASSERT_EQ(run({"--help"}), 0);
  expect_documented(json, said);
}

TEST_F(RecordedEvents, AreShownWithTheirCircumstances) {
  ASSERT_EQ(run({"show", kAlarm}), 0) << said;
  EXPECT_THAT(said, testing::AllOf(HasSubstr("hot_spot_width raised"), HasSubstr("Flügel 7"),
                                   HasSubstr("321")));
  ASSERT_EQ(run({"show", kAlarm, "--json"}), 0) << said;
  EXPECT_EQ(parsed(said)["summary"]["pictures"]["thermal"], 321);
}

TEST_F(RecordedEvents, ArePinnedAndDeleted) {
  ASSERT_EQ(run({"pin", kAlarm}), 0) << said;
  ASSERT_EQ(run({"list", "--json"}), 0);
  EXPECT_EQ(parsed(said)["events"][0]["pinned"], true);
  ASSERT_EQ(run({"unpin", kAlarm}), 0) << said;
  ASSERT_EQ(run({"list", "--json"}), 0);
  EXPECT_EQ(parsed(said)["events"][0]["pinned"], false);
  ASSERT_EQ(run({"rm", kAlarm}), 0) << said;
  EXPECT_FALSE(exists(kAlarm));
  EXPECT_TRUE(exists(kLayer));
}

TEST_F(RecordedEvents, OtherNamesAreRefusedAndNothingIsDeleted) {
  std::ofstream(path("mine")) << "x";
  for (const char* const name : {"../mine", "..", ".", "/", "20261128T090000.125Z-alarm/../.."}) {
    EXPECT_EQ(run({"rm", name}), 1) << name;
    EXPECT_THAT(said, HasSubstr("is not the name of an event"));
  }
  EXPECT_EQ(run({"rm", "20261128T090000.126Z-alarm"}), 1);
  EXPECT_THAT(said, HasSubstr("there is no event"));
  EXPECT_EQ(run({"rm"}), 2);
  EXPECT_EQ(run({"rm", kAlarm, "--json"}), 2);
  EXPECT_TRUE(std::filesystem::exists(path("mine")));
  EXPECT_TRUE(exists(kAlarm));
  EXPECT_TRUE(exists(kLayer));
}

TEST_F(RecordedEvents, OneThatIsBeingRecordedIsNotDeleted) {
  std::filesystem::rename(path(std::string("events/") + kAlarm),
                          path(std::string("events/") + kAlarm + ".unfinished"));
  EXPECT_EQ(run({"rm", kAlarm}), 1);
  EXPECT_THAT(said, HasSubstr("is being recorded"));
  EXPECT_TRUE(exists(std::string(kAlarm) + ".unfinished"));
}

}  // namespace
}  // namespace orbwatch::tests
