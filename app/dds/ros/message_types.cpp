#include "app/dds/ros/message_types.h"

#include "app/dds/ros/idl_reader.h"

namespace orbwatch::app {
namespace {

constexpr std::string_view kIdl =
#include "app/dds/ros/idl_text.inc"
    ;

}  // namespace

const Result<MessageTypes>& message_types() {
  static const Result<MessageTypes> types = read_idl(kIdl);
  return types;
}

}  // namespace orbwatch::app
