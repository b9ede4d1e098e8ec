// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/web/web_sink.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/fastdds/pace.h"
#include "tests/app/ports/dds/test_views.h"
#include "tests/app/ports/web/abuses.h"
#include "tests/app/ports/web/served.h"
#include "tests/support/temporary_folder.h"

/// Regularity of pictures at a viewer while others abuse the server, and waits of the pipeline.
namespace orbwatch::bench {
namespace {

using namespace app;  // NOLINT(google-build-using-namespace): the bench speaks of nothing else
using app::web::tests::Client;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr double kAim = 1.2;  // p99 of the interval, as a multiple of that without abuse

/// Passes on prepared pictures of 1280x720.
class Pictures final : public app::tests::Pace {
 public:
  explicit Pictures(WebSink& sink) : sink_(sink) {
    for (std::uint64_t n = 0; n < kPictures; ++n) {
      views_.push_back(app::tests::make_view(0, "front", n, 1280, 720));
    }
  }

 private:
  static constexpr std::uint64_t kPictures = 4;

  void hand_over_now(std::uint64_t number) override {
    const auto& view = views_[number % kPictures];
    view->frame_set = number;
    view->stamp = hal::Clock::now();
    app::tests::hand_over(sink_, view);
  }

  WebSink& sink_;
  std::vector<std::shared_ptr<View>> views_;
};

/// Intervals between the ends of pictures at a client that reads without pause, ms, until the
/// server ends.
std::vector<double> intervals(Client& viewer) {
  std::vector<double> times;
  std::optional<hal::TimePoint> before;
  while (viewer.receive_until("--orbwatch\r\n")) {
    viewer.take_until("--orbwatch\r\n");
    const auto now = hal::Clock::now();
    if (before) times.push_back(Milliseconds(now - *before).count());
    before = now;
  }
  std::ranges::sort(times);
  return times;
}

struct Seen {
  std::vector<double> intervals;  ///< sorted
  std::uint64_t pictures = 0;     ///< number passed on
  std::uint64_t waits = 0;        ///< number of hand-overs in which the pipeline's thread waited
};

/// Measures with a new server for each abuse, so that none is affected by an earlier one, with
/// limits that admit all clients.
Seen watched(const orbwatch::tests::Abuse* abuse, int seconds) {
  WebSettings settings;
  settings.enabled = true;
  settings.port = 0;
  settings.max_connections = 400;
  settings.max_connections_per_address = 300;
  settings.max_streams = 200;
  const orbwatch::tests::TemporaryFolder folder;
  WebContext context = web::tests::make_context();
  context.state_folder = folder.path();
  const std::string header = web::tests::add_users(folder.path());
  auto sink = std::make_unique<WebSink>(settings, context);
  if (const auto started = sink->start(); !started) {
    throw std::runtime_error(started.error().message);
  }
  sink->accept(app::tests::make_status());
  Client viewer(sink->port());
  viewer.send(web::tests::request_text("GET", "/stream.mjpg?view=front", header));
  auto seen = std::async(std::launch::async, [&] { return intervals(viewer); });
  std::optional<orbwatch::tests::Abused> abused;
  if (abuse != nullptr) abused.emplace(*abuse, sink->port());
  Pictures pictures(*sink);
  pictures.hand_over(seconds * 1000 / static_cast<int>(Pictures::kPeriod.count()));
  abused.reset();
  sink.reset();
  return {seen.get(), pictures.accepted(), pictures.waits()};
}

double quantile(const std::vector<double>& sorted, double part) {
  return sorted.at(static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1)));
}

/// Prints a row; returns the p99 of the interval.
double report(std::string_view name, const Seen& seen, double p99_without) {
  const double p99 = quantile(seen.intervals, 0.99);
  std::printf("| %s | %zu | %.1f | %.1f | %.2f | %llu of %llu |\n", std::string(name).c_str(),
              seen.intervals.size(), quantile(seen.intervals, 0.5), p99,
              p99 / (p99_without > 0 ? p99_without : p99),
              static_cast<unsigned long long>(seen.waits),
              static_cast<unsigned long long>(seen.pictures));
  std::fflush(stdout);
  return p99;
}

int run(int seconds) {
  std::printf(
      "| abuse | intervals | p50, ms | p99, ms | p99 / p99 without | waits of the "
      "pipeline |\n|---|---:|---:|---:|---:|---:|\n");
  const double without = report("none", watched(nullptr, seconds), 0);
  double worst = without;
  for (const auto& abuse : web::tests::abuses()) {
    worst = std::max(worst, report(abuse.name, watched(&abuse, seconds), without));
  }
  if (worst <= kAim * without) return 0;
  std::fprintf(stderr, "web_bench: worst p99 is %.2f of that without abuse, the aim is %.1f\n",
               worst / without, kAim);
  return std::getenv("CI") != nullptr ? 0 : 1;  // times are not evaluated there
}

}  // namespace
}  // namespace orbwatch::bench

int main(int argc, char** argv) {
  const int seconds = argc == 2 ? std::atoi(argv[1]) : 0;
  if (seconds < 1) {
    std::fprintf(stderr, "web_bench SECONDS: measures each abuse for so long\n");
    return 2;
  }
  try {
    return orbwatch::bench::run(seconds);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "web_bench: %s\n", error.what());
    return 1;
  }
}
