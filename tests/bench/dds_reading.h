#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/app/ports/dds/fastdds/reader_program.h"
#include "tests/app/ports/dds/fastdds/shipped_network.h"

namespace orbwatch::bench {

/// Reads pictures with the product's own means until SIGTERM and prints a line for each. Throws
/// std::runtime_error; the exit code of a program.
int read_pictures(int domain, const std::string& topic);

/// Who reads: the product's own DDS, with the same settings as the writer, or another vendor's.
enum class Vendor { Ours, Foreign };

std::string name_of(Vendor vendor);

using Readers = std::vector<std::unique_ptr<orbwatch::tests::ReaderProgram>>;

/// Starts readers of one topic of pictures, reliable as most are.
Readers start_readers(const app::tests::ShippedNetwork& network, const std::string& topic,
                      Vendor vendor, int count);

/// Pictures so far.
std::uint64_t received(const orbwatch::tests::ReaderProgram& reader);

/// The size of the newest one.
double newest_kilobytes(const orbwatch::tests::ReaderProgram& reader);

/// The pictures of each, once nothing comes any more.
std::vector<std::uint64_t> settled(const Readers& readers);

}  // namespace orbwatch::bench
