// SPDX-License-Identifier: Apache-2.0

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

#include "tests/bench/dds_case.h"
#include "tests/bench/dds_outage.h"
#include "tests/bench/dds_reading.h"

/// Cost of DDS for the writer of pictures, and losses and delays of its readers.
namespace orbwatch::bench {
namespace {

constexpr const char* kUsage =
    "dds_bench SECONDS: measures each case for so long\n"
    "dds_bench --read DOMAIN TOPIC: a reader of pictures, which the cases start\n";

/// True if every aim was reached.
bool run(std::chrono::seconds duration) {
  bool reached = true;
  std::puts(kCaseHeader);
  for (const DdsCase& one : dds_cases()) {
    const CaseFigures figures = measure(one, duration);
    print(one, figures);
    reached &= figures.lost <= one.allowed_loss && figures.cpu_ms <= one.allowed_cpu_ms &&
               figures.waits == 0;
  }
  const OutageFigures outage = measure_outage();
  print(outage);
  return reached && outage.reached();
}

}  // namespace
}  // namespace orbwatch::bench

int main(int argc, char** argv) {
  using namespace orbwatch;
  try {
    if (argc == 4 && std::string_view(argv[1]) == "--read") {
      return bench::read_pictures(std::atoi(argv[2]), argv[3]);
    }
    const int seconds = argc == 2 ? std::atoi(argv[1]) : 0;
    if (seconds < 1) {
      std::fputs(bench::kUsage, stderr);
      return 2;
    }
    if (bench::run(std::chrono::seconds(seconds))) return 0;
    std::fputs("dds_bench: an aim was missed\n", stderr);
    return std::getenv("CI") != nullptr ? 0 : 1;  // times are not evaluated there
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dds_bench: %s\n", error.what());
    return 1;
  }
}
