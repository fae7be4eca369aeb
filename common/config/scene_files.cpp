#include "common/config/scene_files.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <sstream>
#include <vector>

#include "common/config/config.hpp"
#include "common/config/user_file.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;

int line_of(const std::string& text, std::size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

void add(proto::Bodies& bodies, const std::string& name, std::string text) {
  proto::SceneFile& file = *bodies.add_file();
  file.set_name(name);
  file.set_text(std::move(text));
}

using Point = std::array<double, 3>;

// Corners of one face, from 0.
std::vector<std::size_t> corners(std::istringstream& line, std::size_t points, const std::string& where) {
  std::vector<std::size_t> face;
  for (std::string word; line >> word;) {
    long number = 0;
    try {
      number = std::stol(word);
    } catch (const std::exception&) {
    }
    if (number < 0) number += static_cast<long>(points) + 1;
    if (number < 1 || number > static_cast<long>(points))
      throw ConfigError(where + "the face refers to vertex \"" + word + "\", but only " +
                        std::to_string(points) + " vertices are defined before it");
    face.push_back(static_cast<std::size_t>(number - 1));
  }
  if (face.size() < 3)
    throw ConfigError(where + "the face has " + std::to_string(face.size()) +
                      " corners; a face needs at least three");
  return face;
}

std::string read_beside(const std::string& where, const fs::path& file) {
  try {
    return read_user_file(file);
  } catch (const ConfigError& error) {
    throw ConfigError(where + error.what());
  }
}

}  // namespace

void require_closed_mesh(const std::string& name, const std::string& obj) {
  std::map<Point, std::size_t> known;  // vertices at one place are one
  std::vector<std::size_t> points;
  std::map<std::pair<std::size_t, std::size_t>, int> edges;  // to the line of their face
  std::istringstream text(obj);
  int number = 0;
  for (std::string row; std::getline(text, row);) {
    const std::string where = name + ":" + std::to_string(++number) + ": ";
    std::istringstream line(row);
    std::string kind;
    line >> kind;
    if (kind == "v") {
      Point p;
      if (!(line >> p[0] >> p[1] >> p[2])) throw ConfigError(where + "a vertex needs three numbers");
      points.push_back(known.try_emplace(p, known.size()).first->second);
    } else if (kind == "f") {
      const auto face = corners(line, points.size(), where);
      for (std::size_t i = 0; i < face.size(); ++i) {
        const std::pair edge{points[face[i]], points[face[(i + 1) % face.size()]]};
        const auto [first, fresh] = edges.try_emplace(edge, number);
        if (!fresh)
          throw ConfigError(where + "the face has an edge in the same direction as the face on line " +
                            std::to_string(first->second) +
                            "; list the vertices of each face anticlockwise, as seen from outside");
      }
    }
  }
  if (edges.empty()) throw ConfigError(name + ": the mesh has no faces");
  for (const auto& [edge, line] : edges) {
    if (!edges.contains({edge.second, edge.first}))
      throw ConfigError(name + ":" + std::to_string(line) +
                        ": the mesh is not closed: an edge of this face belongs to no other face");
  }
}

void load_scene_files(proto::Bodies& bodies, const std::function<fs::path(const std::string& name)>& find) {
  // What is in place stays, unless a setting has named another file since.
  if (bodies.file_size() > 0 && (bodies.mjcf_file().empty() || bodies.file(0).name() == bodies.mjcf_file()))
    return;
  bodies.clear_file();
  if (bodies.mjcf_file().empty()) throw ConfigError("scene.bodies.mjcf_file is empty; name an MJCF file");
  const fs::path file = find(bodies.mjcf_file());
  const std::string mjcf = read_user_file(file);
  add(bodies, bodies.mjcf_file(), mjcf);
  static const std::regex kNamed("\\bfile\\s*=\\s*[\"']([^\"']{0,255})[\"']");
  for (std::sregex_iterator at(mjcf.begin(), mjcf.end(), kNamed), end; at != end; ++at) {
    const std::string name = (*at)[1],
                      where = file.string() + ":" +
                              std::to_string(line_of(mjcf, static_cast<std::size_t>(at->position()))) + ": ";
    const fs::path beside = file.parent_path() / name;
    if (name.find('/') != std::string::npos || fs::path(name).extension() != ".obj")
      throw ConfigError(where + "\"" + name +
                        "\" is not an OBJ file in the MJCF file's folder; copy the mesh there as an "
                        "OBJ file");
    const std::string obj = read_beside(where, beside);
    require_closed_mesh(beside.string(), obj);
    add(bodies, name, obj);
  }
}

}  // namespace longreach
