#include "proc/remap/grid/tile.h"

#include <bit>

namespace orbwatch::remap {

void TileTable::set_index(std::size_t number, std::uint32_t index) {
  // Words between the last tile and this one have none of their own.
  const auto before = static_cast<std::uint32_t>(indices_.size());
  while (words_.size() <= number / 64) words_.push_back({0, before});
  words_.back().own |= std::uint64_t{1} << (number % 64);
  indices_.push_back(index);
}

std::uint32_t TileTable::index(std::size_t number) const {
  const Word& word = words_[number / 64];
  const std::uint64_t earlier = word.own & ((std::uint64_t{1} << (number % 64)) - 1);
  return indices_[word.before + static_cast<std::uint32_t>(std::popcount(earlier))];
}

std::size_t TileTable::bytes() const {
  return records_.size() * sizeof(Record) + words_.size() * sizeof(Word) +
         indices_.size() * sizeof(indices_.front());
}

}  // namespace orbwatch::remap
