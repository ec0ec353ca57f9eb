#include "host/segment/image_list.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <system_error>

#include "host/segment/image_file.hpp"

namespace fencepost::host {

namespace {

namespace fs = std::filesystem;

bool is_named_like_an_image(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

ImageList from_folder(const std::string& folder, const PosesTable& table) {
  ImageList list;
  std::set<fs::path> named;
  std::error_code ignored;
  for (const ImagePose& row : table.rows) {
    const fs::path path = fs::path(folder) / row.image;
    if (!fs::exists(path, ignored)) {
      throw SegmentProblem{table.place(row), "names " + row.image + ", which is not in " + folder,
                           "correct the name, or take the line out"};
    }
    named.insert(path.lexically_normal());
    list.views.push_back({path.string(), row.pose});
  }
  for (const std::string& path : images_in(folder)) {
    if (!named.contains(fs::path(path).lexically_normal())) ++list.without_pose;
  }
  return list;
}

/// The table's only line for this file.
const ImagePose& row_of(const std::string& path, const PosesTable& table) {
  const auto is_path = [&](const ImagePose& row) { return row.image == path; };
  const auto exact = std::find_if(table.rows.begin(), table.rows.end(), is_path);
  if (exact != table.rows.end()) return *exact;
  const fs::path name = fs::path(path).filename();
  const auto is_name = [&](const ImagePose& row) { return fs::path(row.image).filename() == name; };
  const auto first = std::find_if(table.rows.begin(), table.rows.end(), is_name);
  if (first == table.rows.end()) {
    throw SegmentProblem{path, "has no pose in " + table.file, "add a line image,t,x,y,heading for it"};
  }
  const auto second = std::find_if(first + 1, table.rows.end(), is_name);
  if (second != table.rows.end()) {
    throw SegmentProblem{table.place(*second), "names a second " + name.string(), "give the image as the table has it"};
  }
  return *first;
}

ImageList from_files(const std::vector<std::string>& files, const PosesTable& table) {
  std::vector<std::pair<const ImagePose*, std::string>> found;
  for (const std::string& path : files) {
    const ImagePose& row = row_of(path, table);
    const auto same = [&](const auto& other) { return other.first == &row; };
    const auto other = std::find_if(found.begin(), found.end(), same);
    if (other != found.end()) {
      throw SegmentProblem{path, "and " + other->second + " are one image for " + table.place(row), "give one of them"};
    }
    found.emplace_back(&row, path);
  }
  std::sort(found.begin(), found.end());  // rows lie one after the other in memory
  ImageList list;
  for (const auto& [row, path] : found) list.views.push_back({path, row->pose});
  return list;
}

}  // namespace

std::vector<std::string> images_in(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_named_like_an_image(entry->path())) paths.push_back(entry->path().string());
  }
  if (error) throw SegmentProblem{folder, "cannot be read", "check the name and the permissions"};
  std::sort(paths.begin(), paths.end());
  return paths;
}

ImageList list_images(const std::vector<std::string>& sources, const PosesTable& table) {
  std::error_code ignored;
  const auto is_folder = [&](const std::string& path) { return fs::is_directory(path, ignored); };
  if (sources.size() == 1 && is_folder(sources[0])) return from_folder(sources[0], table);
  const auto folder = std::find_if(sources.begin(), sources.end(), is_folder);
  if (folder != sources.end()) {
    throw SegmentProblem{*folder, "is a folder among other images", "give one folder, or image files"};
  }
  return from_files(sources, table);
}

}  // namespace fencepost::host
