#include "split_mapf/io/map_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "split_mapf/core/error.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/io/movingai.h"

namespace split_mapf {

std::shared_ptr<const Grid> readMap(const std::string& path, const OccupancyRule& rule) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".map") return readMovingAiMap(path);
  if (extension == ".yaml" || extension == ".yml") return readMapServerMap(path, rule).grid;
  throw InputError(path + ": cannot tell the form of this map, expected a MovingAI .map or a " +
                   "map_server .yaml");
}

}  // namespace split_mapf
