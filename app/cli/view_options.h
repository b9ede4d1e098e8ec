#pragma once

#include <vector>

#include "app/cli/options.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// What a view is unless options say otherwise.
inline constexpr optics::ViewSpec kDefaultView{
    optics::ViewKind::Perspective, {}, {}, {}, 1280, 720};

/// The options that describe a view; they write into `view`, which must live as long.
std::vector<Option> view_options(optics::ViewSpec& view);

}  // namespace orbwatch::app
