#include "app/dds/ros/type_hash.h"

#include <openssl/evp.h>

#include <array>
#include <set>
#include <vector>

#include "app/dds/ros/idl_reader.h"
#include "app/dds/ros/message_types.h"
#include "app/json/json_object.h"

namespace orbwatch::app {
namespace {

// The JSON below is hashed byte by byte: names, order and blanks are those of
// rosidl_generator_type_description.

void describe(JsonObject& object, const MessageField& field) {
  object.field("name", field.name);
  object.object("type", [&field](JsonObject& type) {
    type.field("type_id", static_cast<int>(field.kind) + static_cast<int>(field.count));
    type.field("capacity", field.capacity);
    type.field("string_capacity", field.string_capacity);
    type.field("nested_type_name", field.nested);
  });
}

void describe(JsonObject& object, const MessageType& type) {
  object.field("type_name", type.name);
  object.list("fields", type.fields.size(),
              [&type](JsonObject& field, std::size_t i) { describe(field, type.fields[i]); });
}

/// A type and, by name, everything it is made of.
std::string description(const MessageType& type, const std::vector<MessageType>& referenced) {
  JsonObject whole(JsonLayout::OneLine);
  whole.object("type_description", [&type](JsonObject& object) { describe(object, type); });
  whole.list("referenced_type_descriptions", referenced.size(),
             [&referenced](JsonObject& object, std::size_t i) { describe(object, referenced[i]); });
  return whole.text();
}

void collect(const MessageTypes& types, const MessageType& type, std::set<std::string>& names) {
  for (const MessageField& field : type.fields) {
    if (field.nested.empty() || !names.insert(field.nested).second) continue;
    collect(types, types.at(field.nested), names);
  }
}

Result<std::string> sha256(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    return fail("OpenSSL offers no SHA-256, which the type hashes of ROS 2 need");
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hexadecimal;
  for (unsigned i = 0; i < size; ++i) {
    hexadecimal += kDigits[digest[i] >> 4];
    hexadecimal += kDigits[digest[i] & 15];
  }
  return hexadecimal;
}

}  // namespace

Result<std::string> type_hash(const MessageTypes& types, std::string_view name) {
  const auto found = types.find(name);
  if (found == types.end()) return fail("no message type " + std::string(name) + " in the IDL");
  std::set<std::string> names;
  collect(types, found->second, names);
  std::vector<MessageType> referenced;
  referenced.reserve(names.size());
  for (const std::string& other : names) referenced.push_back(types.at(other));
  return sha256(description(found->second, referenced)).map([](const std::string& digest) {
    return "RIHS01_" + digest;
  });
}

Result<> announce_type_hash(const Qos& qos, const dds_topic_descriptor_t& type) {
  const auto& types = message_types();
  if (!types) return tl::unexpected(types.error());
  return type_hash(*types, ros_type_name(type.m_typename)).map([&qos](const std::string& hash) {
    const std::string user_data = "typehash=" + hash + ";";
    dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  });
}

}  // namespace orbwatch::app
