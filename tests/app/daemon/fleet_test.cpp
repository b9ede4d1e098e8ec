// SPDX-License-Identifier: Apache-2.0
// Appliances on computers of their own at one switch, found by DDS discovery alone.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/ports/dds/fleet/fleet_reader.h"
#include "app/ports/dds/participant/participant.h"
#include "tests/app/ports/web/http_client.h"
#include "tests/support/lan.h"
#include "tests/support/reference_data.h"
#include "tests/support/share.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {
namespace {

using app::Fleet;
using Clock = std::chrono::steady_clock;

constexpr int kAll = 20;
/// Smallest fleet: one appliance that stays, one that is killed, one that is disconnected.
constexpr int kLeast = 3;
constexpr int kPort = 8080;

constexpr const char* kRig = R"(
[[camera]]
name = "colour"
width = 200
height = 200
[camera.outline]
centre = [99.5, 99.5]
radius = 90
distance = 12
rotation = [0, 0, 0]
)";

constexpr const char* kSite = R"(
[modbus]
enabled = false
[web]
enabled = true
address = "0.0.0.0"
[[camera]]
name = "colour"
back_end = "test_pattern"
width = 200
height = 200
frame_rate = 1
[camera.test_pattern]
pixel_format = "nv12"
[[view]]
name = "room"
kind = "equirectangular"
width = 200
height = 100
[[view.source]]
camera = "colour"
)";

/// Reader of the domain, by a participant of its own on the present thread's computer.
struct Reader {
  Reader() : participant(app::dds::Participant::join(0).value()) {
    EXPECT_TRUE(reader.open(participant.entity()));
  }

  std::vector<Fleet::Entry> list() { return fleet.list(Clock::now()); }

  Fleet fleet;
  app::dds::Participant participant;
  app::dds::FleetReader reader{fleet};
};

std::ptrdiff_t present(const std::vector<Fleet::Entry>& entries) {
  return std::ranges::count(entries, false, &Fleet::Entry::is_gone);
}

class FleetOfDaemons : public testing::Test {
 protected:
  FleetOfDaemons() { unsetenv("CYCLONEDDS_URI"); }

  void start(std::size_t index) {
    const std::string name = "cell " + std::to_string(index);
    const auto file = folder_ / ("site" + std::to_string(index) + ".toml");
    // Once: the others read it.
    if (!std::filesystem::exists(folder_ / "rig.toml")) std::ofstream(folder_ / "rig.toml") << kRig;
    std::ofstream(file) << "rig = \"rig.toml\"\nstate_folder = \"state" << index
                        << "\"\n[dds]\nname = \"" << name << "\"\nprefix = \"cell" << index
                        << "\"\n"
                        << kSite;
    lan_->computer(index).run([&] {
      daemons_[index] = std::make_unique<Subprocess>(
          std::vector<std::string>{ORBWATCHD_PROGRAM, "--config", file.string()},
          folder_ / (name + ".log"));
    });
  }
  /// Waits for the condition; returns the time in seconds.
  double time_until(const std::function<bool()>& condition) const {
    const auto begin = Clock::now();
    while (!condition()) {
      if (Clock::now() - begin > std::chrono::minutes(2)) {
        ADD_FAILURE() << "never; the first one says: " << daemons_[0]->output();
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polls real programs
    }
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }
  std::string list(const std::string& seconds) const {
    Subprocess program({ORBWATCH_PROGRAM, "list", "--appliances", "--seconds", seconds},
                       folder_ / "list");
    EXPECT_EQ(program.wait(), 0) << program.output();
    return program.output();
  }
  /// List on the page of the first appliance.
  std::string page() const {
    std::string body;
    lan_->computer(0).run([&] { body = app::web::tests::get(kPort, "/api/v1/appliances").body; });
    return body;
  }
  static std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
    return found;
  }
  /// Resident memory of all daemons together, MiB.
  int resident() const {
    long pages = 0;
    for (const auto& daemon : daemons_) {
      long size = 0, here = 0;
      std::ifstream("/proc/" + std::to_string(daemon->pid()) + "/statm") >> size >> here;
      pages += here;
    }
    return static_cast<int>(pages * sysconf(_SC_PAGESIZE) >> 20);
  }
  /// Records a duration; checks the limit only if nothing else runs.
  static void expect_within(double limit, double seconds, const char* what) {
    RecordProperty(what, std::to_string(seconds) + " s");
    if (acceptance_mode()) {
      EXPECT_LE(seconds, limit) << what;
    }
  }

  TemporaryFolder folder_;
  std::optional<Lan> lan_;
  std::vector<std::unique_ptr<Subprocess>> daemons_;
};

TEST_F(FleetOfDaemons, ListsAllAndMarksThoseThatDieOrAreCutOff) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  const std::size_t all = static_cast<std::size_t>(std::max(kLeast, share_of(kAll)));
  const std::size_t killed = all - 1, cut_off = all - 2;
  lan_.emplace(all + 1);
  daemons_.resize(all);
  for (std::size_t n = 0; n < all; ++n) start(n);
  lan_->computer(all).run([&] {
    const auto everybody_is_in = [&](Reader& reader) {
      const auto entries = reader.list();
      return entries.size() == all && present(entries) == static_cast<std::ptrdiff_t>(all) &&
             std::ranges::all_of(entries, [](const Fleet::Entry& entry) {
               return entry.notice.state == app::SystemState::Running;
             });
    };
    {
      Reader early;
      RecordProperty("all appliances run after",
                     std::to_string(time_until([&] { return everybody_is_in(early); })) + " s");
    }
    std::optional<Reader> reader;
    expect_within(5, time_until([&] {
                    if (!reader) reader.emplace();
                    return everybody_is_in(*reader);
                  }),
                  "all appliances are listed after");
    const std::string listed = list(acceptance_mode() ? "5" : "3");
    for (std::size_t n = 0; n < all; ++n) {
      EXPECT_THAT(listed, testing::HasSubstr("https://" + Lan::address(n) + ":8443/"));
    }
    EXPECT_EQ(count(page(), "\"is_gone\":false"), all);
    RecordProperty("resident memory of all daemons", std::to_string(resident()) + " MiB");

    daemons_[killed]->send(SIGKILL);
    lan_->pull(cut_off);
    const auto marked = [&] {
      return present(reader->list()) == static_cast<std::ptrdiff_t>(all - 2);
    };
    expect_within(10, time_until(marked), "two that died are marked after");
    EXPECT_EQ(reader->list().size(), all);
    time_until([&] { return count(page(), "\"is_gone\":true") == 2; });

    daemons_[killed]->wait();
    start(killed);
    lan_->plug(cut_off);
    time_until([&] { return everybody_is_in(*reader); });
  });
  for (const auto& daemon : daemons_) daemon->send(SIGTERM);
  for (const auto& daemon : daemons_) EXPECT_EQ(daemon->wait(), 0) << daemon->output();
}

}  // namespace
}  // namespace orbwatch::tests
