#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orbwatch::app {

/// What a field holds. The numbers are those of type_description_interfaces/msg/FieldType, which
/// type hashes are made of.
enum class FieldKind : std::uint8_t {
  Nested = 1,
  Int8 = 2,
  Uint8 = 3,
  Int16 = 4,
  Uint16 = 5,
  Int32 = 6,
  Uint32 = 7,
  Int64 = 8,
  Uint64 = 9,
  Float = 10,
  Double = 11,
  Boolean = 15,
  Byte = 16,
  String = 17,
  BoundedString = 21,
};

/// How many of them. In FieldType this number is added to that of the kind.
enum class FieldCount : std::uint8_t { One = 0, Array = 48, Sequence = 144 };

/// A kind with a name of its own, in IDL and in .msg files.
struct BasicType {
  FieldKind kind;
  std::string_view idl;
  std::string_view msg;
};

inline constexpr std::array kBasicTypes{
    BasicType{FieldKind::Int8, "int8", "int8"},
    BasicType{FieldKind::Uint8, "uint8", "uint8"},
    BasicType{FieldKind::Int16, "int16", "int16"},
    BasicType{FieldKind::Uint16, "uint16", "uint16"},
    BasicType{FieldKind::Int32, "int32", "int32"},
    BasicType{FieldKind::Uint32, "uint32", "uint32"},
    BasicType{FieldKind::Int64, "int64", "int64"},
    BasicType{FieldKind::Uint64, "uint64", "uint64"},
    BasicType{FieldKind::Float, "float", "float32"},
    BasicType{FieldKind::Double, "double", "float64"},
    BasicType{FieldKind::Boolean, "boolean", "bool"},
    BasicType{FieldKind::Byte, "octet", "byte"},
    BasicType{FieldKind::String, "string", "string"},
};

struct MessageField {
  std::string name;
  FieldKind kind = FieldKind::Nested;
  FieldCount count = FieldCount::One;
  std::uint32_t capacity = 0;         ///< of an array
  std::uint32_t string_capacity = 0;  ///< of a bounded string
  std::string nested;                 ///< name of the nested type, else empty
  std::string comment;                ///< one line, may be empty
};

/// A message as ROS 2 sees it.
struct MessageType {
  std::string name;                  ///< as ROS 2 writes it: "sensor_msgs/msg/Image"
  std::vector<std::string> comment;  ///< lines
  std::vector<MessageField> fields;
};

/// By name.
using MessageTypes = std::map<std::string, MessageType, std::less<>>;

}  // namespace orbwatch::app
