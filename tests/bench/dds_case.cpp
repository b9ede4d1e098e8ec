#include "tests/bench/dds_case.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "tests/app/dds/fastdds/paced_views.h"

namespace orbwatch::bench {

namespace {

using app::tests::ShippedNetwork;

const std::string kTopic = "rt/orbwatch/front/image_raw";
constexpr double kAnyCost = std::numeric_limits<double>::infinity();

/// All threads of this process, user and system.
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

app::TopicStatistics statistics_of(const app::DdsSink& sink) {
  const auto statistics = sink.statistics();
  const auto found = std::ranges::find(statistics.topics, kTopic, &app::TopicStatistics::topic);
  if (found == statistics.topics.end()) throw std::runtime_error("no topic " + kTopic);
  return *found;
}

/// Until each reader has its first picture.
void wait_for_all(const Readers& readers, app::tests::PacedViews& views) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!std::ranges::all_of(readers, [](const auto& r) { return received(*r) > 0; })) {
    views.hand_over();
    if (std::chrono::steady_clock::now() > give_up) {
      throw std::runtime_error("a reader gets nothing of " + kTopic);
    }
  }
}

double worst_loss(const std::vector<std::uint64_t>& before, const std::vector<std::uint64_t>& after,
                  std::uint64_t written) {
  double worst = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto got = static_cast<double>(after[i] - before[i]);
    worst = std::max(worst, 1 - got / static_cast<double>(written));
  }
  return worst;
}

}  // namespace

std::vector<DdsCase> dds_cases() {
  using Kind = ShippedNetwork::Kind;
  constexpr double kFew = 0.01;
  constexpr double kCheap = 3;
  return {
      {"1080p rgb8, 6.2 MB", Kind::SameHost, 1920, 1080, Vendor::Ours, 1, kFew, kCheap},
      {"1080p rgb8, 6.2 MB", Kind::SameHost, 1920, 1080, Vendor::Foreign, 1, kFew, kCheap},
      {"2.1 MB, as 1080p mono8", Kind::SameHost, 1920, 360, Vendor::Ours, 1, kFew, kCheap},
      {"2.1 MB, as 1080p mono8", Kind::SameHost, 1920, 360, Vendor::Ours, 4, kFew, kAnyCost},
      {"2.1 MB, as 1080p mono8", Kind::SameHost, 1920, 360, Vendor::Foreign, 4, kFew, kAnyCost},
      {"300 kB, as a JPEG", Kind::Lan, 400, 250, Vendor::Ours, 1, 0, kAnyCost},
      {"300 kB, as a JPEG", Kind::Lan, 400, 250, Vendor::Foreign, 1, 0, kAnyCost},
  };
}

CaseFigures measure(const DdsCase& one, std::chrono::seconds duration) {
  const ShippedNetwork network(one.network);
  app::DdsSink sink({.domain = app::tests::kDomain}, app::tests::make_names(), nullptr);
  network.start(sink);
  std::vector<std::shared_ptr<app::View>> pictures;
  for (std::uint64_t set = 1; set <= app::kViewBuffers; ++set) {
    pictures.push_back(app::tests::make_view(0, "front", set, one.width, one.height));
  }
  app::tests::PacedViews views(sink, pictures);
  const Readers readers = start_readers(network, kTopic, one.vendor, one.readers);
  wait_for_all(readers, views);

  const auto received_before = settled(readers);
  const auto accepted_before = views.accepted();
  const auto written_before = statistics_of(sink).written;
  const auto dropped_before = statistics_of(sink).replaced;
  const double cpu_before = cpu_seconds();
  const double memory_before = resident_mb();
  views.restart();
  views.hand_over(static_cast<int>(duration / app::tests::PacedViews::kPeriod));
  CaseFigures figures;
  figures.accepted = views.accepted() - accepted_before;
  const double cpu = cpu_seconds() - cpu_before;
  figures.memory_growth_mb = resident_mb() - memory_before;
  const auto received_after = settled(readers);
  figures.written = statistics_of(sink).written - written_before;
  figures.dropped = statistics_of(sink).replaced - dropped_before;
  figures.lost = worst_loss(received_before, received_after, figures.written);
  figures.cpu_ms = cpu * 1000 / static_cast<double>(figures.written);
  figures.waits = views.waits();
  figures.longest_wait_ms = views.longest_wait_ms();
  return figures;
}

const char* const kCaseHeader =
    "| picture | network | readers | handed over | written | replaced | lost by the worst, % | "
    "writer's CPU, ms each | waits of the pipeline | longest, ms | memory, MB more |\n"
    "|---|---|---|---:|---:|---:|---:|---:|---:|---:|---:|";

void print(const DdsCase& one, const CaseFigures& figures) {
  std::printf("| %s | %s | %d %s | %llu | %llu | %llu | %.2f | %.2f | %llu | %.2f | %.1f |\n",
              one.name.c_str(),
              one.network == ShippedNetwork::Kind::SameHost ? "same host" : "cable, MTU 1500",
              one.readers, name_of(one.vendor).c_str(),
              static_cast<unsigned long long>(figures.accepted),
              static_cast<unsigned long long>(figures.written),
              static_cast<unsigned long long>(figures.dropped), figures.lost * 100, figures.cpu_ms,
              static_cast<unsigned long long>(figures.waits), figures.longest_wait_ms,
              figures.memory_growth_mb);
  std::fflush(stdout);
}

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double all = 0;
  double resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

}  // namespace orbwatch::bench
