// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/camera_stream.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

#include "hal/pixel_format_words.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal::recording {
namespace {

constexpr std::array kMatrices{Word{"bt601", ColourMatrix::Bt601},
                               Word{"bt709", ColourMatrix::Bt709}};
constexpr std::array kRanges{Word{"limited", ColourRange::Limited},
                             Word{"full", ColourRange::Full}};

/// Writes entries.
struct EntryWriter {
  mcap::StringMap& metadata;

  template <class Words, class T>
  void word(const char* name, const Words& words, const T& value) {
    metadata.emplace_back(name, word_for(words, value));
  }
  void number(const char* name, const double& value, double) {
    std::array<char, 32> text{};
    char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    metadata.emplace_back(name, std::string(text.data(), end));
  }
};

/// Reads entries; the first wrong one is the error.
struct EntryReader {
  const mcap::StringMap& metadata;
  Result<> result = {};

  const std::string* text(std::string_view name) const {
    const auto found = std::ranges::find(metadata, name, &mcap::StringMap::value_type::first);
    return found == metadata.end() || !result ? nullptr : &found->second;
  }
  void refuse(std::string_view name, const std::string& right) {
    result = fail("metadata of the channel: " + std::string(name) + " must be " + right);
  }

  template <class Words, class T>
  void word(const char* name, const Words& words, T& value) {
    const std::string* const stated = text(name);
    if (stated == nullptr) return;
    if (const auto* const found = find_word(words, *stated)) {
      value = *found;
    } else {
      refuse(name, "one of " + joined(words));
    }
  }
  void number(const char* name, double& value, double most) {
    const std::string* const stated = text(name);
    if (stated == nullptr) return;
    const char* const end = stated->data() + stated->size();
    double number = 0;
    const auto [stop, error] = std::from_chars(stated->data(), end, number);
    const bool is_right = error == std::errc() && stop == end && std::abs(number) <= most;
    if (!is_right) return refuse(name, "a number of at most " + std::to_string(most));
    value = number;
  }
};

template <class Format, class Entries>
void visit(Entries& entries, Format& format) {
  constexpr double kMostKelvin = 10'000;
  entries.word("pixel_format", kPixelFormatWords, format.format);
  entries.word("colour_matrix", kMatrices, format.colour_space.matrix);
  entries.word("colour_range", kRanges, format.colour_space.range);
  entries.number("frame_rate", format.frame_rate, kMaxFrameRate);
  entries.number("kelvin_per_count", format.kelvin_per_count, kMostKelvin);
  entries.number("kelvin_offset", format.kelvin_offset, kMostKelvin);
}

}  // namespace

mcap::StringMap metadata_of(const StreamFormat& format) {
  mcap::StringMap metadata;
  EntryWriter entries{metadata};
  visit(entries, format);
  return metadata;
}

Result<> read_metadata(const mcap::StringMap& metadata, StreamFormat& format) {
  StreamFormat read = format;
  EntryReader entries{metadata};
  visit(entries, read);
  if (entries.result) format = read;
  return entries.result;
}

std::optional<int> jpeg_quality_in(const mcap::StringMap& metadata) {
  const auto found = std::ranges::find(metadata, kJpegQuality, &mcap::StringMap::value_type::first);
  if (found == metadata.end()) return std::nullopt;
  const char* const end = found->second.data() + found->second.size();
  int quality = 0;
  const auto [stop, error] = std::from_chars(found->second.data(), end, quality);
  const bool is_right = error == std::errc() && stop == end && quality >= 1 && quality <= 100;
  return is_right ? std::optional(quality) : std::nullopt;
}

}  // namespace orbwatch::hal::recording
