#pragma once

#include <string>

#include "app/dds/entity.h"

namespace orbwatch::app {

/// One topic and its reader. Thread rule: one owner.
class TopicReader {
 public:
  TopicReader(const dds_topic_descriptor_t& type, std::string name)
      : type_(&type), name_(std::move(name)) {}

  /// Creates topic and reader. `listener`, if there is one, is copied; it may be called before this
  /// returns. Error: DDS refuses.
  Result<> open(const Entity& participant, const Qos& qos,
                const dds_listener_t* listener = nullptr);
  /// Waits for the listener to end; it is not called afterwards.
  void close();

  dds_entity_t get() const { return reader_.get(); }
  const std::string& name() const { return name_; }
  const char* type_name() const { return type_->m_typename; }

 private:
  const dds_topic_descriptor_t* type_;
  std::string name_;
  Entity topic_;
  Entity reader_;
};

}  // namespace orbwatch::app
