#pragma once

#include <iosfwd>
#include <optional>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "tool/command_line.h"

namespace split_mapf::tool {

/// Formats of the field's own viewers.
enum class ViewerFormat {
  kPlanViz,         ///< the result file of the League of Robot Runners
  kMapfVisualizer,  ///< a line a step: "0:(x,y),(x,y),"
};

/// Declares --export.
void declareViewerFormat(CommandLine& line);
/// What --export asks for. @throws OptionError for another format, without --output, and with
/// --write-better, which writes our own format.
std::optional<ViewerFormat> readViewerFormat(const CommandLine& line);

/// Writes a plan so that the viewer shows it.
void writeForViewer(std::ostream& out, ViewerFormat format, const Instance& instance,
                    const Plan& plan);

}  // namespace split_mapf::tool
