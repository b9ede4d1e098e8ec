#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/ports/dds/security/access_documents.h"

namespace orbwatch::app {

/// The rights that orbwatchd needs for these topics.
TopicAccess appliance_access(std::string_view prefix);

/// The rights of its readers, and of readers that also send commands.
TopicAccess reader_access(std::string_view prefix);
TopicAccess controller_access(std::string_view prefix);

/// The topics of pictures.
std::vector<std::string> bulk_topics(std::string_view prefix);

}  // namespace orbwatch::app
