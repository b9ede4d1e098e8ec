// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/dds_outage.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "tests/bench/dds_case.h"
#include "tests/bench/dds_reading.h"

namespace orbwatch::bench {

namespace {

using app::tests::kDomain;
using app::tests::Pace;
using app::tests::ShippedNetwork;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kOutage(15);

double seconds_since(Clock::time_point moment) {
  return std::chrono::duration<double>(Clock::now() - moment).count();
}

double slowest_state(const ShippedNetwork& network) {
  double slowest = 0;
  for (int i = 0; i < 10; ++i) {
    orbwatch::tests::ReaderProgram late(
        network.readers(), orbwatch::tests::foreign_reader(
                               kDomain, {"--topic", "rt/orbwatch/process_state", "--type",
                                         "orbwatch_msgs::msg::dds_::ProcessState_", "--count", "1",
                                         "--transient-local", "--seconds", "60"}));
    late.program().wait();
    const auto samples = late.samples();
    if (samples.empty()) throw std::runtime_error("a late reader got no state");
    const double waited = orbwatch::tests::parsed(samples.front())["since_match_ms"];
    slowest = std::max(slowest, waited);
  }
  return slowest;
}

/// Seconds until each reader receives another picture.
std::vector<double> time_to_next(const Readers& readers, Pace& pace) {
  const auto begin = Clock::now();
  std::vector<std::uint64_t> before;
  for (const auto& reader : readers) before.push_back(received(*reader));
  std::vector<double> waited(readers.size(), 0);
  while (std::ranges::find(waited, 0.0) != waited.end()) {
    pace.hand_over();
    for (std::size_t i = 0; i < readers.size(); ++i) {
      if (waited[i] == 0 && received(*readers[i]) > before[i]) waited[i] = seconds_since(begin);
    }
    if (seconds_since(begin) > 120) throw std::runtime_error("a reader gets no more pictures");
  }
  return waited;
}

}  // namespace

OutageFigures measure_outage() {
  const ShippedNetwork network(ShippedNetwork::Kind::Lan);
  app::dds::DdsSink sink(settings_for(Pictures::SmallView), app::tests::make_names(), nullptr);
  network.start(sink);
  sink.accept(app::tests::make_status());
  OutageFigures figures;
  figures.state_ms = slowest_state(network);

  const auto pace = paced(Pictures::SmallView, sink);
  const std::string topic = topic_of(Pictures::SmallView);
  Readers readers = start_readers(network, topic, Vendor::Ours, 1);
  readers.push_back(std::move(start_readers(network, topic, Vendor::Foreign, 1).front()));
  time_to_next(readers, *pace);
  pace->hand_over(60);
  const double memory_before = resident_mb();
  network.cable().pull();
  pace->restart();
  pace->hand_over(static_cast<int>(kOutage / Pace::kPeriod));
  figures.memory_growth_mb = resident_mb() - memory_before;
  network.cable().plug();
  pace->restart();
  const auto back = time_to_next(readers, *pace);
  figures.ours_back_s = back[0];
  figures.foreign_back_s = back[1];
  figures.waits = pace->waits();
  figures.longest_wait_ms = pace->longest_wait_ms();
  return figures;
}

void print(const OutageFigures& figures) {
  std::printf(
      "\n| over a cable | figure |\n|---|---:|\n"
      "| the last state, slowest of 10 late readers, ms from matching | %.1f |\n"
      "| pictures again after 15 s without cable, Cyclone DDS, s | %.2f |\n"
      "| the same, Fast DDS, s | %.2f |\n"
      "| memory of the writer while the cable was out, MB more | %.1f |\n"
      "| waits of the pipeline | %llu |\n"
      "| the longest of them, ms | %.2f |\n",
      figures.state_ms, figures.ours_back_s, figures.foreign_back_s, figures.memory_growth_mb,
      figures.waits, figures.longest_wait_ms);
}

}  // namespace orbwatch::bench
