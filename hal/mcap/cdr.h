// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "hal/mcap/fields.h"

/// Messages of ROS 2 in plain CDR (XCDR1, little-endian) behind the four bytes of encapsulation:
/// the message encoding "cdr" of channels. A message is a struct with visit(), as the records of
/// record.h; members are numbers, bool, std::string, arrays, vectors and such structs, and a span
/// of bytes for uint8[], which is copied when written and lies in the message when read.
namespace orbwatch::hal::mcap {

inline constexpr std::array kCdrLittleEndian{std::byte{0}, std::byte{1}, std::byte{0},
                                             std::byte{0}};

template <class T>
concept CdrNumber = std::integral<T> || std::floating_point<T>;

/// Unsigned integer with the bits of a number.
template <CdrNumber T>
using CdrBits = std::conditional_t<
    sizeof(T) == 8, std::uint64_t,
    std::conditional_t<sizeof(T) == 4, std::uint32_t,
                       std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;

/// Appends members to a message.
class CdrWriter {
 public:
  /// Begins a message in `out`, which is cleared and must outlive this.
  explicit CdrWriter(Bytes& out) : out_(out) {
    out.assign(kCdrLittleEndian.begin(), kCdrLittleEndian.end());
  }

  template <class... Members>
  void operator()(const Members&... members) {
    (put(members), ...);
  }

 private:
  template <CdrNumber T>
  void put(T value) {
    const std::size_t unaligned = (out_.size() - kCdrLittleEndian.size()) % sizeof(T);
    if (unaligned != 0) out_.resize(out_.size() + sizeof(T) - unaligned);
    FieldWriter fields(out_);
    fields(std::bit_cast<CdrBits<T>>(value));
  }
  void put(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    const auto bytes = std::as_bytes(std::span(text.c_str(), text.size() + 1));
    out_.insert(out_.end(), bytes.begin(), bytes.end());
  }
  void put(std::span<const std::byte> bytes) {
    put(static_cast<std::uint32_t>(bytes.size()));
    out_.insert(out_.end(), bytes.begin(), bytes.end());
  }
  template <class T, std::size_t kSize>
  void put(const std::array<T, kSize>& values) {
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint32_t>(values.size()));
    for (const T& value : values) put(value);
  }
  template <class Struct>
  requires std::is_class_v<Struct>
  void put(const Struct& part) { Struct::visit(part, *this); }

  Bytes& out_;
};

/// Reads members of a message of any origin, which must outlive it. The memory of what is read is
/// bounded by the size of the message, except for vectors of structs: up to sizeof(Struct) times.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::byte> message) : message_(message) {}

  /// True for little-endian plain CDR.
  bool is_readable() const {
    return message_.size() >= kCdrLittleEndian.size() &&
           std::ranges::equal(message_.first(2), std::span(kCdrLittleEndian).first(2));
  }

  /// False: the message ends before, or a string has no end.
  template <class... Members>
  bool operator()(Members&... members) {
    return (get(members) && ...);
  }

 private:
  std::size_t left() const { return message_.size() - std::min(at_, message_.size()); }

  template <CdrNumber T>
  bool get(T& value) {
    const std::size_t unaligned = (at_ - kCdrLittleEndian.size()) % sizeof(T);
    if (unaligned != 0) at_ += sizeof(T) - unaligned;
    if (left() < sizeof(T)) return false;
    CdrBits<T> bits = 0;
    FieldReader fields(message_.subspan(at_));
    fields(bits);
    at_ += sizeof(T);
    if constexpr (std::same_as<T, bool>) {
      value = bits != 0;
    } else {
      value = std::bit_cast<T>(bits);
    }
    return true;
  }
  bool get(std::string& text) {
    std::span<const std::byte> bytes;
    if (!get(bytes) || bytes.empty() || bytes.back() != std::byte{0}) return false;
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size() - 1);
    return true;
  }
  bool get(std::span<const std::byte>& bytes) {
    std::uint32_t size = 0;
    if (!get(size) || size > left()) return false;
    bytes = message_.subspan(at_, size);
    at_ += size;
    return true;
  }
  template <class T, std::size_t kSize>
  bool get(std::array<T, kSize>& values) {
    return std::ranges::all_of(values, [this](T& value) { return get(value); });
  }
  template <class T>
  bool get(std::vector<T>& values) {
    std::uint32_t size = 0;
    if (!get(size) || size > left()) return false;  // each element has a byte at least
    values.clear();
    for (std::uint32_t k = 0; k < size; ++k) {
      if (!get(values.emplace_back())) return false;
    }
    return true;
  }
  template <class Struct>
  requires std::is_class_v<Struct>
  bool get(Struct& part) { return Struct::visit(part, *this); }

  std::span<const std::byte> message_;
  std::size_t at_ = kCdrLittleEndian.size();
};

/// A message in `out`, which is replaced.
template <class Message>
void encode_cdr(const Message& message, Bytes& out) {
  CdrWriter writer(out);
  Message::visit(message, writer);
}

/// True if `bytes` are such a message; false: another encapsulation, or damaged. Spans in `message`
/// lie in `bytes`.
template <class Message>
bool decode_cdr(std::span<const std::byte> bytes, Message& message) {
  CdrReader reader(bytes);
  return reader.is_readable() && Message::visit(message, reader);
}

}  // namespace orbwatch::hal::mcap
