// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/cdr.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/config.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

/// Messages in plain CDR, compared with eProsima's Fast CDR.
namespace orbwatch::hal::mcap {
namespace {

using eprosima::fastcdr::Cdr;

#if FASTCDR_VERSION_MAJOR < 2
constexpr auto kPlainCdr = Cdr::DDS_CDR;
std::size_t length(const Cdr& cdr) { return cdr.getSerializedDataLength(); }
#else
constexpr auto kPlainCdr = eprosima::fastcdr::CdrVersion::DDS_CDR;
std::size_t length(const Cdr& cdr) { return cdr.get_serialized_data_length(); }
#endif

struct Part {
  std::uint8_t small = 0;
  double number = 0;
  std::string text;

  bool operator==(const Part&) const = default;
  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.small, self.number, self.text);
  }
};

/// A member of each kind, at every alignment.
struct Everything {
  bool truth = false;
  std::int16_t two = 0;
  std::string text;
  std::int64_t eight = 0;
  float four = 0;
  std::array<double, 3> array{};
  std::span<const std::byte> bytes;
  std::vector<std::uint32_t> numbers;
  std::vector<std::string> texts;
  std::vector<Part> parts;
  Part last;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.truth, self.two, self.text, self.eight, self.four, self.array, self.bytes,
                  self.numbers, self.texts, self.parts, self.last);
  }
};

Everything example(std::size_t size, std::span<const std::byte> bytes) {
  Everything message{true,
                     -2,
                     std::string(size, 't'),
                     std::numeric_limits<std::int64_t>::min(),
                     1.5F,
                     {1, -2, 1e300},
                     bytes,
                     {},
                     {},
                     {},
                     {9, 0.25, "end"}};
  for (std::size_t k = 0; k < size; ++k) {
    message.numbers.push_back(static_cast<std::uint32_t>(k << 20));
    message.texts.push_back(std::string(k, 'a'));
    message.parts.push_back({static_cast<std::uint8_t>(k), 1.0 / 3, std::string(size - k, 'p')});
  }
  return message;
}

void write_part(Cdr& cdr, const Part& part) { cdr << part.small << part.number << part.text; }

/// The same message by Fast CDR.
Bytes by_fast_cdr(const Everything& message) {
  std::vector<char> memory(10'000, 0);  // Fast CDR leaves padding as it is
  eprosima::fastcdr::FastBuffer buffer(memory.data(), memory.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, kPlainCdr);
  cdr.serialize_encapsulation();
  std::vector<std::uint8_t> bytes(message.bytes.size());
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    bytes[k] = std::to_integer<std::uint8_t>(message.bytes[k]);
  }
  cdr << message.truth << message.two << message.text << message.eight << message.four
      << message.array << bytes << message.numbers << message.texts;
  cdr << static_cast<std::uint32_t>(message.parts.size());
  for (const Part& part : message.parts) write_part(cdr, part);
  write_part(cdr, message.last);
  const auto written = std::as_bytes(std::span(memory).first(length(cdr)));
  return {written.begin(), written.end()};
}

TEST(Cdr, IsThatOfFastCdr) {
  const Bytes data(5, std::byte{200});
  for (std::size_t size = 0; size < 10; ++size) {
    const Everything message = example(size, std::span(data).first(size % 6));
    Bytes written(3);  // replaced
    encode_cdr(message, written);
    EXPECT_EQ(written, by_fast_cdr(message)) << size;
  }
}

TEST(Cdr, IsReadAsWritten) {
  const Bytes data(5, std::byte{200});
  const Everything message = example(6, data);
  const Bytes written = by_fast_cdr(message);
  Everything read;
  ASSERT_TRUE(decode_cdr(written, read));
  EXPECT_EQ(read.truth, message.truth);
  EXPECT_EQ(read.two, message.two);
  EXPECT_EQ(read.text, message.text);
  EXPECT_EQ(read.eight, message.eight);
  EXPECT_EQ(read.four, message.four);
  EXPECT_EQ(read.array, message.array);
  EXPECT_TRUE(std::ranges::equal(read.bytes, message.bytes));
  EXPECT_EQ(read.numbers, message.numbers);
  EXPECT_EQ(read.texts, message.texts);
  EXPECT_EQ(read.parts, message.parts);
  EXPECT_EQ(read.last, message.last);
}

TEST(Cdr, DamagedMessagesAreRefused) {
  const Bytes data(5);
  Bytes written = by_fast_cdr(example(4, data));
  Everything read;
  for (std::size_t size = 0; size < written.size(); ++size) {
    EXPECT_FALSE(decode_cdr(std::span(written).first(size), read)) << size;
  }
  Bytes big_endian = written;
  big_endian[1] = std::byte{0};
  EXPECT_FALSE(decode_cdr(big_endian, read));
  Bytes parameters = written;
  parameters[1] = std::byte{3};
  EXPECT_FALSE(decode_cdr(parameters, read));
  // Length of the text: 4 bytes of encapsulation, bool, padding, int16.
  for (std::size_t k = 8; k < 12; ++k) written[k] = std::byte{255};
  EXPECT_FALSE(decode_cdr(written, read));
}

TEST(Cdr, ATextMustHaveAnEnd) {
  Bytes written;
  encode_cdr(Part{1, 2, "end"}, written);
  Part read;
  ASSERT_TRUE(decode_cdr(written, read));
  written.back() = std::byte{'s'};
  EXPECT_FALSE(decode_cdr(written, read));
}

}  // namespace
}  // namespace orbwatch::hal::mcap
