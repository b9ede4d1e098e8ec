// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/app/ports/dds/fastdds/reader_program.h"
#include "tests/app/ports/dds/fastdds/shipped_network.h"

namespace orbwatch::bench {

/// Reads pictures with the product's own classes until SIGTERM and prints a line for each. Throws
/// std::runtime_error; returns the exit code of a program.
int read_pictures(int domain, const std::string& topic);

/// DDS implementation of a reader: the product's own, with the same settings as the writer, or
/// another vendor's.
enum class Vendor { Ours, Foreign };

std::string name_of(Vendor vendor);

using Readers = std::vector<std::unique_ptr<orbwatch::tests::ReaderProgram>>;

/// Starts readers of one topic of pictures, reliable like most readers.
Readers start_readers(const app::tests::ShippedNetwork& network, const std::string& topic,
                      Vendor vendor, int count);

/// Number of pictures so far.
std::uint64_t received(const orbwatch::tests::ReaderProgram& reader);

/// The size of the newest picture.
double newest_kilobytes(const orbwatch::tests::ReaderProgram& reader);

/// The number of pictures of each, after reception has ended.
std::vector<std::uint64_t> settled(const Readers& readers);

}  // namespace orbwatch::bench
