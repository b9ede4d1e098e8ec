// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/dds_pictures.h"
#include "tests/bench/dds_reading.h"

namespace orbwatch::bench {

/// Pictures at 30 per second to some readers.
struct DdsCase {
  std::string name;
  app::tests::ShippedNetwork::Kind network;
  Pictures pictures;
  Vendor vendor;
  int readers;
  double allowed_loss;    ///< share of the pictures handed over
  double allowed_cpu_ms;  ///< the writing process's, per picture
};

/// The cases in the order of the table.
std::vector<DdsCase> dds_cases();

struct CaseFigures {
  std::uint64_t accepted = 0;
  std::uint64_t written = 0;
  std::uint64_t dropped = 0;  ///< number replaced by a newer one before they were written
  double kilobytes = 0;       ///< size of the newest picture as received
  double lost = 0;            ///< share of those handed over, for the reader that lost most
  double cpu_ms = 0;          ///< the writing process's, per picture
  std::uint64_t waits = 0;    ///< hand-overs in which the pipeline had to wait
  double longest_wait_ms = 0;
  double memory_growth_mb = 0;  ///< the writing process's
};

/// Measures a case with networks, readers and a sink of its own. Throws std::runtime_error when a
/// reader receives nothing.
CaseFigures measure(const DdsCase& one, std::chrono::seconds duration);

extern const char* const kCaseHeader;
void print(const DdsCase& one, const CaseFigures& figures);

/// Resident memory of this process, megabytes.
double resident_mb();

}  // namespace orbwatch::bench
