// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/cli/dds/received_state.h"
#include "tests/app/daemon/daemon_program.h"
#include "tests/hal/genicam/fake_gige_camera.h"
#include "tests/support/network_namespace.h"
#include "tests/support/reference_data.h"
#include "tests/support/share.h"

/// Runs orbwatchd with Aravis' fake GigE Vision camera, in a network of their own.
namespace orbwatch::tests {
namespace {

std::string camera_of_rig(const std::string& name) {
  return "[[camera]]\nname = \"" + name + R"("
width = 160
height = 120
[camera.outline]
centre = [79.5, 59.5]
radius = 55
alpha = 343.571
)";
}

/// Rig with more cameras than a site needs to run.
const std::string kRig = kMachine + camera_of_rig("thermal") + camera_of_rig("colour");

const std::string kRecipe = R"(
name = "ramp"
[[view]]
name = "front"
measured = "thermal"
width = 64
height = 48
[[view.source]]
camera = "thermal"
[[region]]
name = "front"
view = "front"
hot_spot_threshold = 100
)";

const std::string kStatedScale = "kelvin_per_count = 0.04\n";

/// Site with `keys` for the camera.
std::string site(const std::string& keys, int frame_rate = 100) {
  return R"(
[[camera]]
name = "thermal"
back_end = "genicam"
width = 160
height = 120
frame_rate = )" +
         std::to_string(frame_rate) + "\n" + keys + R"([camera.genicam]
camera = "127.0.0.1"
pixel_format = "Mono16"
)";
}

class GenicamDaemon : public Daemon {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
    setenv("ORBWATCH_MODULES", ORBWATCH_BUILT_MODULES, 1);
  }
  void TearDown() override { unsetenv("ORBWATCH_MODULES"); }

  using Work = std::function<void(Subprocess&, FakeGigeCamera&)>;

  /// Executes `work` while a daemon measures the camera's frames.
  void run(const std::string& keys, const Work& work) {
    run_with({}, site(kStatedScale + keys), work);
  }
  void run_with(const FakeGigeCamera::Options& options, const std::string& site, const Work& work) {
    const NetworkNamespace network;
    network.run([&] {
      FakeGigeCamera fake(options);
      Subprocess daemon = start(write_config(site, kRig, kRecipe));
      ASSERT_TRUE(eventually(daemon, [&] { return read("system_heartbeat") > 0; }))
          << daemon.output();
      work(daemon, fake);
      daemon.send(SIGTERM);
      EXPECT_EQ(daemon.wait(), 0) << daemon.output();
    });
  }

  bool delivers(Subprocess& daemon) {
    return eventually(daemon, [&] { return read("camera_0_fault") == 0; }) &&
           eventually(daemon, [&, before = read("camera_0_frames")] {
             return read("camera_0_frames") > before;
           });
  }
};

/// Number of rounds, which mostly wait: `whole` in acceptance mode, else `few`.
int whole_or(int whole, int few) { return acceptance_mode() ? share_of(whole) : few; }

std::size_t open_files(const Subprocess& program) {
  const std::filesystem::directory_iterator first("/proc/" + std::to_string(program.pid()) + "/fd");
  return static_cast<std::size_t>(std::distance(begin(first), end(first)));
}

/// Resident memory, KiB.
long resident(const Subprocess& program) {
  std::ifstream status("/proc/" + std::to_string(program.pid()) + "/status");
  std::string word;
  long size = 0;
  while (status >> word && word != "VmRSS:") continue;
  status >> size;
  return size;
}

TEST_F(GenicamDaemon, MeasuresAgainAfterEachReturnOfTheCameraAndNothingGrows) {
  run("", [&](Subprocess& daemon, FakeGigeCamera& fake) {
    ASSERT_TRUE(delivers(daemon)) << daemon.output();
    std::size_t files = 0;
    long memory = 0;
    const int restarts = whole_or(100, 3);
    for (int round = 0; round < restarts; ++round) {
      fake.kill();
      ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_fault") != 0; }))
          << daemon.output();
      fake.start();
      ASSERT_TRUE(delivers(daemon)) << daemon.output();
      if (round > 0) continue;
      // Libraries keep some files open after their first use.
      files = open_files(daemon);
      memory = resident(daemon);
    }
    EXPECT_TRUE(eventually(daemon, [&] { return open_files(daemon) <= files; }))
        << open_files(daemon) << ", before " << files;
    constexpr long kNoise = 16384;
    EXPECT_LE(resident(daemon), memory + kNoise + 16L * restarts);
    EXPECT_EQ(read("camera_0_underruns"), 0);
  });
}

TEST_F(GenicamDaemon, MeasuresTemperaturesByTheScaleThatTheCameraSays) {
  const std::string linear = "[[camera.control]]\nname = \"IRFormat\"\nvalue = 2\n";
  run_with({.is_thermal = true}, site("radiometric = true\n") + linear,
           [&](Subprocess& daemon, FakeGigeCamera&) {
             ASSERT_TRUE(delivers(daemon)) << daemon.output();
             // Counts reach 65534, each 0.01 K; the hot spot begins at 100 degC.
             const auto peak = [this] { return read("region_0_hot_spot_peak_temperature"); };
             ASSERT_TRUE(eventually(daemon, [&] { return peak() >= 1000; })) << peak();
             EXPECT_LE(peak(), 3822);
           });
}

TEST_F(GenicamDaemon, IsSynchronisedWithAColourCameraByStampsAndTheSkewIsReported) {
  constexpr std::int64_t kWindow = 20;  // ms: half a period, each frame has one partner
  const std::string pair = "[pipeline]\nsync_window_ms = " + std::to_string(kWindow) +
                           "\nsync_max_wait_ms = 100\n" + site(kStatedScale, 25) + R"(
[[camera]]
name = "colour"
back_end = "test_pattern"
width = 160
height = 120
frame_rate = 25
[camera.test_pattern]
pixel_format = "rgb"
)";
  run_with({}, pair, [&](Subprocess& daemon, FakeGigeCamera&) {
    ASSERT_TRUE(delivers(daemon)) << daemon.output();
    // A busy computer sometimes delivers late: counting restarts from there.
    constexpr std::int64_t kSets = 50;
    auto sets = read("system_frame_set"), unmatched = read("system_unmatched");
    ASSERT_TRUE(eventually(daemon,
                           [&] {
                             const auto sets_now = read("system_frame_set"),
                                        unmatched_now = read("system_unmatched");
                             if (unmatched_now - unmatched > kSets / 10)
                               sets = sets_now, unmatched = unmatched_now;
                             return sets_now >= sets + kSets;
                           }))
        << "never " << kSets << " pairs in succession with fewer than a tenth of the frames alone";
    constexpr std::int64_t kCountsPerMs = 10;
    EXPECT_GT(read("system_skew_ms"), 0) << "two clocks of their own";
    EXPECT_LE(read("system_skew_ms"), kWindow * kCountsPerMs);
    EXPECT_EQ(read("camera_1_fault"), 0);
  });
}

/// Result with its numbers, which are equal in every interface.
struct NumberedResult {
  std::int64_t result = 0;
  std::int64_t trigger = 0;
  std::int64_t frame_set = 0;
  bool operator==(const NumberedResult&) const = default;
};

/// Results received by a reader of the process state over DDS, in the present thread's network.
class ResultsOverDds {
 public:
  explicit ResultsOverDds(int domain) {
    const auto opened = reader_.open(domain);
    EXPECT_TRUE(opened) << opened.error().message;
  }

  /// Takes the newest state, if one has arrived.
  void look() {
    const auto taken = reader_.next(std::chrono::milliseconds(0), [&](const auto& state) {
      const NumberedResult now{static_cast<std::int64_t>(state.result),
                               static_cast<std::int64_t>(state.trigger),
                               static_cast<std::int64_t>(state.frame_set)};
      if (now.result > 0 && (seen_.empty() || seen_.back() != now)) seen_.push_back(now);
    });
    EXPECT_TRUE(taken) << taken.error().message;
  }

  /// Results at each change of one of the numbers.
  const std::vector<NumberedResult>& seen() const { return seen_; }

 private:
  app::cli::StateReader reader_{"orbwatch"};
  std::vector<NumberedResult> seen_;
};

TEST_F(GenicamDaemon, EachSoftwareTriggerGivesOneResultOverModbusAndDds) {
  // The fake camera states 10 ms of exposure but sends at once.
  run("trigger_mode = \"software\"\ntrigger_source = \"software\"\nstamp_offset_us = -10000\n",
      [&](Subprocess& daemon, FakeGigeCamera&) {
        ResultsOverDds dds(domain);
        std::vector<NumberedResult> modbus;
        const auto wait_for = [&](const std::function<bool()>& condition) {
          return eventually(daemon, [&] {
            dds.look();
            return condition();
          });
        };
        const int triggers = whole_or(1000, 30);
        for (int n = 1; n <= triggers; ++n) {
          ASSERT_EQ(command(daemon, app::CommandCode::Trigger), app::CommandResult::Done) << n;
          ASSERT_TRUE(wait_for([&] {
            return read("system_result") >= n && !dds.seen().empty() &&
                   dds.seen().back().result >= n;
          })) << n
              << ": " << daemon.output();
          modbus.push_back(
              {read("system_result"), read("system_trigger"), read("system_frame_set")});
          EXPECT_EQ(modbus.back().result, n);
          EXPECT_EQ(modbus.back().trigger, n);
        }
        // A surplus result would arrive now.
        ASSERT_TRUE(wait_for(
            [&, last = read("system_heartbeat")] { return read("system_heartbeat") >= last + 5; }));
        EXPECT_EQ(dds.seen(), modbus);
        EXPECT_EQ(read("system_result"), triggers);
        EXPECT_EQ(read("camera_0_triggers"), triggers);
        EXPECT_EQ(read("camera_0_missed"), 0);
        EXPECT_EQ(read("camera_0_frames"), triggers);
      });
}

}  // namespace
}  // namespace orbwatch::tests
