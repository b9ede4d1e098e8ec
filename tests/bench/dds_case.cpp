// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/dds_case.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "tests/app/ports/dds/offering_sink.h"

namespace orbwatch::bench {

namespace {

using app::tests::ShippedNetwork;

constexpr double kAnyCost = std::numeric_limits<double>::infinity();

/// CPU seconds of all threads of this process, user and system.
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

app::dds::TopicStatistics statistics_of(const app::dds::DdsSink& sink, const std::string& topic) {
  const auto statistics = sink.statistics();
  const auto found = std::ranges::find(statistics.topics, topic, &app::dds::TopicStatistics::topic);
  if (found == statistics.topics.end()) throw std::runtime_error("no topic " + topic);
  return *found;
}

/// Waits until each reader has its first picture.
void wait_for_all(const Readers& readers, app::tests::Pace& pace) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!std::ranges::all_of(readers, [](const auto& r) { return received(*r) > 0; })) {
    pace.hand_over();
    if (std::chrono::steady_clock::now() > give_up) {
      throw std::runtime_error("a reader gets no picture");
    }
  }
}

double worst_loss(const std::vector<std::uint64_t>& before, const std::vector<std::uint64_t>& after,
                  std::uint64_t accepted) {
  double worst = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto got = static_cast<double>(after[i] - before[i]);
    worst = std::max(worst, 1 - got / static_cast<double>(accepted));
  }
  return worst;
}

}  // namespace

std::vector<DdsCase> dds_cases() {
  using Kind = ShippedNetwork::Kind;
  constexpr double kFew = 0.01;
  constexpr double kCheap = 3;
  return {
      {"view, rgb8", Kind::SameHost, Pictures::View, Vendor::Ours, 1, kFew, kCheap},
      {"view, rgb8", Kind::SameHost, Pictures::View, Vendor::Foreign, 1, kFew, kCheap},
      {"camera, NV12 to mono8", Kind::SameHost, Pictures::Camera, Vendor::Ours, 1, kFew, kCheap},
      {"camera, NV12 to mono8", Kind::SameHost, Pictures::Camera, Vendor::Ours, 4, kFew, kAnyCost},
      {"camera, NV12 to mono8", Kind::SameHost, Pictures::Camera, Vendor::Foreign, 4, kFew,
       kAnyCost},
      {"view, JPEG", Kind::Lan, Pictures::Jpeg, Vendor::Ours, 1, 0, kAnyCost},
      {"view, JPEG", Kind::Lan, Pictures::Jpeg, Vendor::Foreign, 1, 0, kAnyCost},
  };
}

CaseFigures measure(const DdsCase& one, std::chrono::seconds duration) {
  const ShippedNetwork network(one.network);
  app::dds::DdsSink sink =
      app::tests::sink_offering(settings_for(one.pictures), {}, cameras_for(one.pictures));
  network.start(sink);
  const std::string topic = topic_of(one.pictures);
  const auto pace = paced(one.pictures, sink);
  const Readers readers = start_readers(network, topic, one.vendor, one.readers);
  wait_for_all(readers, *pace);

  const auto received_before = settled(readers);
  const auto accepted_before = pace->accepted();
  const auto before = statistics_of(sink, topic);
  const double cpu_before = cpu_seconds();
  const double memory_before = resident_mb();
  pace->restart();
  pace->hand_over(static_cast<int>(duration / app::tests::Pace::kPeriod));
  CaseFigures figures;
  figures.accepted = pace->accepted() - accepted_before;
  const double cpu = cpu_seconds() - cpu_before;
  figures.memory_growth_mb = resident_mb() - memory_before;
  const auto received_after = settled(readers);
  const auto after = statistics_of(sink, topic);
  figures.written = after.written - before.written;
  figures.dropped = after.replaced - before.replaced;
  figures.kilobytes = newest_kilobytes(*readers.front());
  figures.lost = worst_loss(received_before, received_after, figures.accepted);
  figures.cpu_ms = cpu * 1000 / static_cast<double>(figures.written);
  figures.waits = pace->waits();
  figures.longest_wait_ms = pace->longest_wait_ms();
  return figures;
}

const char* const kCaseHeader =
    "| 1080p pictures | kB each | network | readers | handed over | written | replaced | lost by "
    "the worst, % | "
    "writer's CPU, ms each | waits of the pipeline | longest, ms | memory, MB more |\n"
    "|---|---:|---|---|---:|---:|---:|---:|---:|---:|---:|---:|";

void print(const DdsCase& one, const CaseFigures& figures) {
  std::printf(
      "| %s | %.0f | %s | %d %s | %llu | %llu | %llu | %.2f | %.2f | %llu | %.2f | %.1f |\n",
      one.name.c_str(), figures.kilobytes,
      one.network == ShippedNetwork::Kind::SameHost ? "same host" : "cable, MTU 1500", one.readers,
      name_of(one.vendor).c_str(), static_cast<unsigned long long>(figures.accepted),
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
