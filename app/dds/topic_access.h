#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/dds/security/permissions.h"

namespace orbwatch::app {

/// What the orbwatchd of these topics must be allowed.
TopicAccess appliance_access(std::string_view prefix);

/// What its readers must be allowed, and who sends commands besides.
TopicAccess reader_access(std::string_view prefix);
TopicAccess controller_access(std::string_view prefix);

/// The topics of pictures.
std::vector<std::string> bulk_topics(std::string_view prefix);

}  // namespace orbwatch::app
