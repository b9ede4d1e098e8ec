// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "hal/mcap/limits.h"

/// MCAP's encoding of the fields of a record: little-endian integers, strings and maps with a
/// length of 32 bit in front.
namespace orbwatch::hal::mcap {

using Bytes = std::vector<std::byte>;

/// Makes a reused buffer `size` bytes long. Growth drops what it held, before more is allocated.
inline std::span<std::byte> resized(Bytes& buffer, std::size_t size) {
  if (buffer.capacity() < size) Bytes().swap(buffer);
  buffer.resize(size);
  return buffer;
}

/// Appends fields to `out`, which must outlive it.
class FieldWriter {
 public:
  explicit FieldWriter(Bytes& out) : out_(out) {}

  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }

  /// Overwrites the integer at the position `at` of the bytes.
  template <std::unsigned_integral T>
  void set(std::size_t at, T value) {
    for (std::size_t k = 0; k < sizeof(T); ++k) {
      out_[at + k] = static_cast<std::byte>(value >> (8 * k));
    }
  }

 private:
  template <std::unsigned_integral T>
  void put(T value) {
    out_.resize(out_.size() + sizeof(T));
    set(out_.size() - sizeof(T), value);
  }
  void put(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size()));
    const auto bytes = std::as_bytes(std::span(text));
    out_.insert(out_.end(), bytes.begin(), bytes.end());
  }
  template <class Key, class Value>
  void put(const std::vector<std::pair<Key, Value>>& map) {
    put(std::uint32_t{0});
    const std::size_t begin = out_.size();
    for (const auto& [key, value] : map) (*this)(key, value);
    set(begin - sizeof(std::uint32_t), static_cast<std::uint32_t>(out_.size() - begin));
  }

  Bytes& out_;
};

/// Reads fields from the front of bytes of any origin, which must outlive it.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  /// False: a field ends beyond the bytes or exceeds its bound; fault() says which.
  template <class... Values>
  bool operator()(Values&... values) {
    return (get(values) && ...);
  }

  std::span<const std::byte> rest() const { return rest_; }
  std::string_view fault() const { return fault_; }

 private:
  std::span<const std::byte> take(std::size_t count) {
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  bool has(std::size_t count) {
    if (count <= rest_.size()) return true;
    fault_ = "a field ends beyond the record";
    return false;
  }
  template <std::unsigned_integral T>
  bool get(T& value) {
    if (!has(sizeof(T))) return false;
    value = 0;
    const auto bytes = take(sizeof(T));
    for (std::size_t k = 0; k < sizeof(T); ++k) {
      value = static_cast<T>(value | static_cast<T>(std::to_integer<T>(bytes[k]) << (8 * k)));
    }
    return true;
  }
  bool get(std::string& text) {
    std::uint32_t size = 0;
    if (!get(size) || !has(size)) return false;
    const auto bytes = take(size);
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return true;
  }
  template <class Key, class Value>
  bool get(std::vector<std::pair<Key, Value>>& map) {
    std::uint32_t size = 0;
    if (!get(size) || !has(size)) return false;
    FieldReader entries(take(size));
    map.clear();
    while (!entries.rest().empty()) {
      if (std::is_same_v<Key, std::string> && map.size() == kMostMapEntries) {
        fault_ = "a map has more than 64 entries";
        return false;
      }
      auto& [key, value] = map.emplace_back();
      if (entries(key, value)) continue;
      fault_ = "an entry ends beyond its map";
      return false;
    }
    return true;
  }

  std::span<const std::byte> rest_;
  std::string_view fault_;
};

}  // namespace orbwatch::hal::mcap
