// SPDX-License-Identifier: Apache-2.0
#include "app/cli/register/named_pictures.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <utility>

#include "app/cli/options/options.h"
#include "hal/replay/picture_sequence.h"

namespace orbwatch::app::cli {
namespace {

/// A camera, its pictures, and the numbers of those that are read.
struct NamedSequence {
  std::string name;
  hal::PictureSequence pictures;
  std::vector<std::size_t> chosen;
};

CliResult<NamedSequence> open_sequence(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == word.size()) {
    return usage_error("\"" + word + "\" is not CAMERA=PATH");
  }
  std::string name = word.substr(0, equals);
  auto pictures = hal::PictureSequence::open(word.substr(equals + 1), name);
  if (!pictures) return tl::unexpected(pictures.error());
  NamedSequence sequence{std::move(name), std::move(*pictures), {}};
  for (std::size_t n = 0; n < sequence.pictures.size(); ++n) sequence.chosen.push_back(n);
  return sequence;
}

/// Leaves out what the other camera has no picture of; of folders the n-th ones belong together.
void choose_common(NamedSequence& sequence, const hal::PictureSequence& other) {
  std::set<std::uint64_t> sets;
  for (std::size_t n = 0; n < other.size(); ++n) {
    if (const auto stamp = other.set_time(n)) sets.insert(*stamp);
  }
  if (sets.empty()) return;
  std::erase_if(sequence.chosen, [&](std::size_t n) {
    const auto stamp = sequence.pictures.set_time(n);
    return stamp && !sets.contains(*stamp);
  });
}

CliResult<NamedPictures> read_chosen(NamedSequence& sequence) {
  NamedPictures named{sequence.name, {}};
  const std::size_t count = std::min(sequence.chosen.size(), kMostPictures);
  for (const std::size_t n : std::span(sequence.chosen).first(count)) {
    auto decoded = sequence.pictures.read(n);
    if (!decoded) return tl::unexpected(decoded.error());
    named.pictures.push_back(std::move(*decoded));
    const Picture &first = named.pictures.front().picture, &last = named.pictures.back().picture;
    if (last.width != first.width || last.height != first.height || last.format != first.format) {
      return fail(sequence.pictures.path(n) +
                  " is of another size or kind than the pictures before it" +
                  exif_note(named.pictures.back()));
    }
  }
  return named;
}

}  // namespace

std::vector<Picture> NamedPictures::views() const {
  std::vector<Picture> all;
  for (const hal::DecodedPicture& decoded : pictures) all.push_back(decoded.picture);
  return all;
}

CliResult<std::array<NamedPictures, 2>> read_named_pictures(
    const std::array<std::string, 2>& words) {
  auto first = open_sequence(words[0]);
  if (!first) return tl::unexpected(first.error());
  auto second = open_sequence(words[1]);
  if (!second) return tl::unexpected(second.error());
  choose_common(*first, second->pictures);
  choose_common(*second, first->pictures);
  if (first->chosen.empty()) {
    return fail(first->name + " and " + second->name + " have no picture of the same frame set");
  }
  auto pictures = read_chosen(*first);
  if (!pictures) return tl::unexpected(pictures.error());
  auto others = read_chosen(*second);
  if (!others) return tl::unexpected(others.error());
  return std::array{std::move(*pictures), std::move(*others)};
}

}  // namespace orbwatch::app::cli
