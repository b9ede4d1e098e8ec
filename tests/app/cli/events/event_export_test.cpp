// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "app/ports/recorder/events/event_summary.h"
#include "hal/mcap/file.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/daemon/replay/recorded_demo.h"
#include "tests/support/reference_data.h"

/// `orbwatch events export` of what the product's own pipeline recorded of the demo.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;

constexpr const char* kEvent = "20261128T090000.125Z-alarm";

class EventExport : public CommandLine {
 protected:
  static void SetUpTestSuite() { demo_ = new RecordedDemo(40); }
  static void TearDownTestSuite() {
    delete demo_;
    demo_ = nullptr;
  }

  void SetUp() override {
    const std::filesystem::path event = path(std::string("recordings/events/") + kEvent);
    std::filesystem::create_directories(event);
    recording_ = event / "event.mcap";
    demo_->write(recording_);
  }

  int export_to(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"events",           "export", kEvent,    "--folder",
                                       path("recordings"), "-o",     path(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  std::vector<std::string> lines_of(const std::string& name) const {
    std::ifstream file(path(name));
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  std::filesystem::path recording_;
  static RecordedDemo* demo_;
};
RecordedDemo* EventExport::demo_ = nullptr;

TEST_F(EventExport, OfARangeIsMeasuredAsRecorded) {
  ASSERT_EQ(export_to("part.mcap", {"--to", "30"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("part.mcap: 30 frame sets"));
  EXPECT_EQ(run({"replay", path("part.mcap"), "--compare"}), 0) << said;
  EXPECT_THAT(said, testing::AllOf(HasSubstr("0 of "), HasSubstr("frame sets differ")));
}

TEST_F(EventExport, BeginsAndEndsWithTheStatedFrameSets) {
  ASSERT_EQ(export_to("part.mcap", {"--from", "10", "--to", "30"}), 0) << said;
  ASSERT_EQ(run({"replay", path("part.mcap"), "-o", path("measured.csv")}), 0) << said;
  std::set<int> sets;
  for (const std::string& line : lines_of("measured.csv")) {
    if (line.front() != 'u') sets.insert(std::stoi(line.substr(line.find(',') + 1)));
  }
  ASSERT_FALSE(sets.empty());
  EXPECT_GE(*sets.begin(), 10);
  EXPECT_LE(*sets.rbegin(), 30);
}

TEST_F(EventExport, IsReadByTheProgramsOfOthers) {
  const std::filesystem::path readers = ORBWATCH_SOURCE_DIR "/build/mcap-readers/node_modules";
  ORBWATCH_REQUIRE_FILE(readers / "@mcap/core");
  ORBWATCH_REQUIRE_FILE(readers / "fzstd");
  const auto read = [&](const std::filesystem::path& file) {
    Subprocess program(
        {"/usr/bin/env", "NODE_PATH=" + readers.string(), "node",
         ORBWATCH_SOURCE_DIR "/tests/hal/mcap/readers/read.mjs", file.string(), "indexed"},
        folder / "printed");
    EXPECT_EQ(program.wait(), 0) << program.output();
    std::istringstream output(program.output());
    std::set<std::string> lines;
    for (std::string line; std::getline(output, line);) {
      if (!line.starts_with("statistics")) lines.insert(line);
    }
    return lines;
  };
  ASSERT_EQ(export_to("whole.mcap"), 0) << said;
  const auto whole = read(recording_);
  EXPECT_GT(whole.size(), 80U);
  EXPECT_EQ(read(path("whole.mcap")), whole);
  ASSERT_EQ(export_to("part.mcap", {"--from", "10", "--to", "30"}), 0) << said;
  const auto part = read(path("part.mcap"));
  EXPECT_LT(part.size(), whole.size());
  EXPECT_TRUE(std::ranges::includes(whole, part));
}

TEST_F(EventExport, AsATableHasTheSignalsOfEachFrameSet) {
  ASSERT_EQ(export_to("states.csv", {"--from", "10", "--to", "12"}), 0) << said;
  const auto lines = lines_of("states.csv");
  ASSERT_EQ(lines.size(), 1 + 3U);
  EXPECT_THAT(lines[0], HasSubstr(",region.pool.hot_spot_width,"));
  EXPECT_THAT(lines[0], HasSubstr(",machine.layer"));
  EXPECT_THAT(lines[1], HasSubstr("Z,"));
  EXPECT_THAT(lines[1], HasSubstr(",10,"));
  EXPECT_THAT(lines[3], HasSubstr(",12,"));
}

TEST_F(EventExport, AsPicturesHasTheBallOfTheCamera) {
  ASSERT_EQ(export_to("thermal.tif"), 0) << said;
  std::vector<cv::Mat> pages;
  ASSERT_TRUE(cv::imreadmulti(path("thermal.tif"), pages, cv::IMREAD_UNCHANGED));
  EXPECT_EQ(pages.size(), demo_->pictures());
  EXPECT_EQ(pages.at(0).size(), cv::Size(RecordedDemo::kBall.width, RecordedDemo::kBall.height));
  EXPECT_EQ(pages.at(0).type(), CV_16UC1);
}

TEST_F(EventExport, AsAVideoHasThePicturesAndTheirValues) {
  ASSERT_EQ(export_to("plain.avi", {"--from", "10", "--to", "30"}), 0) << said;
  ASSERT_EQ(export_to("drawn.avi", {"--from", "10", "--to", "30", "--draw"}), 0) << said;
  ASSERT_EQ(export_to("all.tif", {"--from", "10", "--to", "30"}), 0) << said;
  std::vector<cv::Mat> pages;
  ASSERT_TRUE(cv::imreadmulti(path("all.tif"), pages, cv::IMREAD_UNCHANGED));
  cv::VideoCapture plain(path("plain.avi")), drawn(path("drawn.avi"));
  std::size_t pictures = 0;
  for (cv::Mat picture, with_text; plain.read(picture) && drawn.read(with_text); ++pictures) {
    EXPECT_EQ(picture.size(), pages.at(0).size());
    EXPECT_GE(with_text.cols, 800);
    ASSERT_GT(with_text.rows, picture.rows + 100) << "signals of two regions, the machine";
    EXPECT_GT(cv::mean(with_text.rowRange(picture.rows, with_text.rows))[0], 2) << "text";
  }
  EXPECT_EQ(pictures, pages.size());
}

TEST_F(EventExport, AsAnArchiveIsUnpackedAsAFolderOfTheEvent) {
  app::recorder::EventSummary summary;
  summary.trigger = "alarm";
  ASSERT_TRUE(app::recorder::write_summary(recording_.parent_path(), summary));
  ASSERT_EQ(export_to("event.zip", {"--to", "30"}), 0) << said;
  std::filesystem::create_directories(path("unpacked/events"));
  Subprocess python(
      {"/usr/bin/python3", "-m", "zipfile", "-e", path("event.zip"), path("unpacked/events")},
      folder / "printed");
  ASSERT_EQ(python.wait(), 0) << python.output();
  ASSERT_EQ(run({"events", "show", kEvent, "--folder", path("unpacked")}), 0) << said;
  const std::string event = std::string("unpacked/events/") + kEvent;
  EXPECT_EQ(lines_of(event + "/states.csv").size(), 1 + 30U);
  EXPECT_EQ(run({"replay", path(event + "/event.mcap"), "--compare"}), 0) << said;
}

TEST_F(EventExport, AnExistingFileIsKeptUnlessForced) {
  write("mine.csv", std::string("mine"));
  EXPECT_EQ(export_to("mine.csv"), 1);
  EXPECT_THAT(said, HasSubstr("say --force"));
  EXPECT_EQ(lines_of("mine.csv"), std::vector<std::string>{"mine"});
  EXPECT_EQ(export_to("mine.csv", {"--force"}), 0) << said;
  EXPECT_GT(lines_of("mine.csv").size(), 1U);
  EXPECT_EQ(folder.files(), 2) << "nothing beside it";
}

TEST_F(EventExport, CtrlCLeavesNoFile) {
  const std::filesystem::path exported = path("exported");
  std::filesystem::create_directory(exported);
  const auto is_writing = [&] { return !std::filesystem::is_empty(exported); };
  // An export may end before the signal: it is stopped while it writes, and tried again otherwise.
  for (int attempt = 0; attempt < 50; ++attempt) {
    Subprocess program({ORBWATCH_PROGRAM, "events", "export", kEvent, "--folder",
                        path("recordings"), "-o", path("exported/drawn.avi"), "--draw"},
                       folder / "printed");
    while (!is_writing() && program.runs()) std::this_thread::yield();
    program.send(SIGSTOP);
    const bool is_done = std::filesystem::exists(exported / "drawn.avi");
    program.send(SIGINT);
    program.send(SIGCONT);
    const int code = program.wait();
    if (is_done || code == 0) {
      std::filesystem::remove(exported / "drawn.avi");
      continue;
    }
    EXPECT_EQ(code, 1) << program.output();
    EXPECT_THAT(program.output(), HasSubstr("cancelled"));
    EXPECT_FALSE(is_writing());
    return;
  }
  ADD_FAILURE() << "no export was interrupted";
}

TEST_F(EventExport, AnEventThatItsRecorderLeftUnfinishedIsDeletedButNotExported) {
  const std::filesystem::path event = recording_.parent_path();
  const std::filesystem::path unfinished = event.string() + ".unfinished";
  std::filesystem::rename(event, unfinished);
  std::filesystem::last_write_time(
      unfinished / "event.mcap",
      std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  const std::vector<std::string> deletion{"events", "rm", kEvent, "--folder", path("recordings")};
  {
    // A recorder locks its file.
    const auto recorder =
        hal::mcap::File::open(unfinished / "event.mcap", hal::mcap::File::Access::Change);
    ASSERT_TRUE(recorder) << recorder.error().message;
    EXPECT_EQ(run(deletion), 1);
    EXPECT_THAT(said, HasSubstr("is being recorded"));
    EXPECT_EQ(export_to("states.csv"), 1);
    EXPECT_THAT(said, HasSubstr("is being recorded; export it afterwards"));
    ASSERT_EQ(run({"events", "list", "--folder", path("recordings")}), 0) << said;
    EXPECT_THAT(said, HasSubstr("yes"));
  }
  ASSERT_EQ(run({"events", "list", "--folder", path("recordings")}), 0) << said;
  EXPECT_THAT(said, testing::Not(HasSubstr("yes")));
  EXPECT_EQ(export_to("states.csv"), 1);
  EXPECT_THAT(said, testing::AllOf(HasSubstr("is not complete, since its recorder ended early"),
                                   HasSubstr("orbwatch events rm deletes it"),
                                   testing::Not(HasSubstr("is being recorded"))));
  EXPECT_FALSE(std::filesystem::exists(path("states.csv")));
  EXPECT_EQ(run(deletion), 0) << said;
  EXPECT_FALSE(std::filesystem::exists(unfinished));
}

TEST_F(EventExport, MistakesLeaveNoFile) {
  const std::string recordings = path("recordings");
  const auto refuse = [&](std::vector<std::string> arguments, std::vector<std::string> says) {
    arguments.insert(arguments.end(), {"--folder", recordings});
    expect_refused("events", {"mistake", std::move(arguments), std::move(says)});
  };
  refuse({"export", kEvent}, {"-o FILE is missing"});
  refuse({"export", kEvent, "-o", "DIR/a.mp4"},
         {"must end with one of .mcap, .csv, .tif, .avi, .zip"});
  refuse({"export", kEvent, "-o", "DIR/mcap"}, {"must end with one of"});
  refuse({"export", "../" + std::string(kEvent), "-o", "DIR/a.csv"},
         {"is not the name of an event"});
  refuse({"export", kEvent, "-o", "DIR/a.csv", "--from", "noon"}, {"--from: \"noon\" must be"});
  refuse({"export", kEvent, "-o", "DIR/a.csv", "--from", "30", "--to", "20"}, {"no frame set"});
  refuse({"export", kEvent, "-o", "DIR/a.csv", "--camera", "thermal"},
         {"--camera is for .tif and .avi"});
  refuse({"export", kEvent, "-o", "DIR/a.tif", "--draw"}, {"--draw is for .avi"});
  refuse({"export", kEvent, "-o", "DIR/a.tif", "--camera", "other"}, {"there is no camera other"});
  refuse({"export", kEvent, "-o", "DIR/missing/a.csv"}, {"missing"});
  refuse({"show", kEvent, "-o", "DIR/a.csv"}, {"are for export"});
  std::filesystem::resize_file(recording_, std::filesystem::file_size(recording_) / 2);
  std::ofstream(recording_, std::ios::in | std::ios::binary | std::ios::ate)
      << std::string(64, 'x');
  refuse({"export", kEvent, "-o", "DIR/a.mcap", "--from", "39"}, {"event.mcap"});
}

}  // namespace
}  // namespace orbwatch::tests
