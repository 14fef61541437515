/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "membrane_mesh_readers.h"
#include "membrane_mesh_text.h"

#include "membrane_mesh_bytes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

using namespace Membrane_NS;

namespace {

// === What the header says

enum class Storage { TEXT, LITTLE_ENDIAN_BINARY, BIG_ENDIAN_BINARY };

enum class Type { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64 };

struct Property {
  std::string name;
  Type type;
  bool is_list;
  Type count_type;    // of a list
};

struct Element {
  std::string name;
  int count;
  std::vector<Property> properties;
};

struct Header {
  Storage storage;
  std::vector<Element> elements;
  size_t size;    // in bytes
  long lines;
};

size_t bytes_of(Type type)
{
  switch (type) {
    case Type::INT8:
    case Type::UINT8:
      return 1;
    case Type::INT16:
    case Type::UINT16:
      return 2;
    case Type::FLOAT64:
      return 8;
    default:
      return 4;
  }
}

Type type_of(const MeshText &text, int word)
{
  static const std::pair<const char *, Type> names[] = {
      {"char", Type::INT8},      {"int8", Type::INT8},       {"uchar", Type::UINT8},
      {"uint8", Type::UINT8},    {"short", Type::INT16},     {"int16", Type::INT16},
      {"ushort", Type::UINT16},  {"uint16", Type::UINT16},   {"int", Type::INT32},
      {"int32", Type::INT32},    {"uint", Type::UINT32},     {"uint32", Type::UINT32},
      {"float", Type::FLOAT32},  {"float32", Type::FLOAT32}, {"double", Type::FLOAT64},
      {"float64", Type::FLOAT64}};
  for (const auto &[name, type] : names)
    if (text[word] == name) return type;
  text.fail("unknown type " + quoted(text[word]) + "; export the mesh as float and int");
}

Header read_header(const std::string &path, std::string_view content)
{
  MeshText text(path, content, '\0');
  if (!text.next_line() || text[0] != "ply")
    text.fail("the word ply is missing at the beginning; is this a PLY file?");

  Header header;
  bool has_format = false;
  while (true) {
    if (!text.next_line())
      text.fail("the header has no end_header: it is truncated; export it again");
    const std::string_view keyword = text[0];
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "end_header") break;
    if (keyword == "format" && text.size() >= 2) {
      has_format = true;
      if (text[1] == "ascii")
        header.storage = Storage::TEXT;
      else if (text[1] == "binary_little_endian")
        header.storage = Storage::LITTLE_ENDIAN_BINARY;
      else if (text[1] == "binary_big_endian")
        header.storage = Storage::BIG_ENDIAN_BINARY;
      else
        text.fail("unknown format " + quoted(text[1]) +
                  "; export as ascii, binary_little_endian or binary_big_endian");
    } else if (keyword == "element" && text.size() == 3) {
      for (const Element &element : header.elements)
        if (element.name == text[1])
          text.fail("a second element " + quoted(text[1]) + "; remove one");
      header.elements.push_back({std::string(text[1]), text.count(2), {}});
    } else if (keyword == "property" && text.size() == 3 && !header.elements.empty()) {
      const Type type = type_of(text, 1);
      header.elements.back().properties.push_back({std::string(text[2]), type, false, type});
    } else if (keyword == "property" && text.size() == 5 && text[1] == "list" &&
               !header.elements.empty()) {
      header.elements.back().properties.push_back(
          {std::string(text[4]), type_of(text, 3), true, type_of(text, 2)});
    } else {
      text.fail("cannot read the header line that begins with " + quoted(keyword) +
                "; export the mesh again");
    }
  }
  if (!has_format) text.fail("the header has no format line; export the mesh again");
  header.size = text.position();
  header.lines = text.line();
  return header;
}

// === The values after the header, one after the other

class Body {
 public:
  Body(const std::string &path, std::string_view content, const Header &header) :
      path_(path), content_(content), storage_(header.storage), position_(header.size),
      text_(path, content, '\0', header.size, header.lines)
  {
  }

  void begin_item(const Element &element, int index)
  {
    element_ = &element;
    index_ = index;
    word_ = 0;
    if (storage_ == Storage::TEXT && !text_.next_line()) fail_truncated();
  }

  double value(Type type)
  {
    if (storage_ == Storage::TEXT) {
      if (word_ == text_.size()) fail("has too few values; correct the line");
      double value;
      if (!parse_number(text_[word_], value))
        fail("has " + quoted(text_[word_]) + " for a number; correct it");
      ++word_;
      return value;
    }
    const size_t bytes = bytes_of(type);
    if (content_.size() - position_ < bytes) fail_truncated();
    const char *data = content_.data() + position_;
    position_ += bytes;
    return decode(data, type);
  }

  void end_item() const
  {
    if (storage_ == Storage::TEXT && word_ != text_.size())
      fail("has more values than the header lists; correct the line");
  }

  void end_file()
  {
    if (storage_ == Storage::TEXT ? text_.next_line() : position_ != content_.size())
      mesh_file_error(path_, storage_ == Storage::TEXT ? text_.line() : 0,
                      "there is more after the last element: the counts of the header are wrong; "
                      "export the mesh again");
  }

  [[noreturn]] void fail(const std::string &problem) const
  {
    const bool is_known = element_->name == "vertex" || element_->name == "face";
    mesh_file_error(path_, storage_ == Storage::TEXT ? text_.line() : 0,
                    (is_known ? element_->name : quoted(element_->name)) + " " +
                        std::to_string(index_) + " " + problem);
  }

 private:
  const std::string &path_;
  std::string_view content_;
  Storage storage_;
  size_t position_;    // in a binary body
  MeshText text_;      // a text body
  int word_ = 0;
  const Element *element_ = nullptr;
  int index_ = 0;

  double decode(const char *data, Type type) const
  {
    const bool big_endian = storage_ == Storage::BIG_ENDIAN_BINARY;
    switch (type) {
      case Type::INT8:
        return load<int8_t>(data, big_endian);
      case Type::UINT8:
        return load<uint8_t>(data, big_endian);
      case Type::INT16:
        return load<int16_t>(data, big_endian);
      case Type::UINT16:
        return load<uint16_t>(data, big_endian);
      case Type::INT32:
        return load<int32_t>(data, big_endian);
      case Type::UINT32:
        return load<uint32_t>(data, big_endian);
      case Type::FLOAT32:
        return load<float>(data, big_endian);
      case Type::FLOAT64:
        break;
    }
    return load<double>(data, big_endian);
  }

  [[noreturn]] void fail_truncated() const
  {
    mesh_file_error(path_, 0,
                    "the file ends in " + quoted(element_->name) + " " + std::to_string(index_) +
                        " of " + std::to_string(element_->count) +
                        ": it is truncated or its counts are wrong; export it again");
  }
};

// a value that must be an integer from 0 to below the limit

int whole_number(const Body &body, double value, double limit, const char *what)
{
  if (!(value >= 0.0 && value < limit) || value != std::floor(value)) {
    std::string number;
    append_number(number, value);
    body.fail("has the " + std::string(what) + " " + number +
              ", which must be an integer from 0 "
              "to below " +
              std::to_string(static_cast<long long>(limit)) + "; correct it");
  }
  return static_cast<int>(value);
}

constexpr double MAX_COUNT = 2147483647.0;

// === Elements

void skip_property(Body &body, const Property &property)
{
  if (!property.is_list) {
    body.value(property.type);
    return;
  }
  const int n = whole_number(body, body.value(property.count_type), MAX_COUNT, "list length");
  for (int i = 0; i < n; ++i) body.value(property.type);
}

void read_vertices(const std::string &path, Body &body, const Element &element, PolygonSoup &soup)
{
  // which coordinate a property is, or -1

  std::vector<int> direction(element.properties.size(), -1);
  for (int d = 0; d < 3; ++d) {
    const std::string name(1, "xyz"[d]);
    int found = 0;
    for (size_t p = 0; p < element.properties.size(); ++p)
      if (element.properties[p].name == name && !element.properties[p].is_list) {
        direction[p] = d;
        ++found;
      }
    if (found != 1)
      mesh_file_error(path, 0,
                      "the header must list the vertex property " + name +
                          " once; export the mesh again");
  }

  for (int v = 0; v < element.count; ++v) {
    body.begin_item(element, v);
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (size_t p = 0; p < element.properties.size(); ++p) {
      if (direction[p] < 0)
        skip_property(body, element.properties[p]);
      else
        point[direction[p]] = body.value(element.properties[p].type);
    }
    if (!point.allFinite()) body.fail("has a coordinate that is not finite; correct it");
    body.end_item();
    soup.points.push_back(point);
  }
}

/// Number of the property that lists the corners of faces or strips.
size_t corner_list(const std::string &path, const Element &element)
{
  for (size_t p = 0; p < element.properties.size(); ++p) {
    const Property &property = element.properties[p];
    if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
      return p;
  }
  mesh_file_error(path, 0,
                  "the header must list the " + element.name +
                      " property vertex_indices; export the mesh again");
}

void read_faces(const std::string &path, Body &body, const Element &element, int num_points,
                PolygonSoup &soup)
{
  const size_t corners = corner_list(path, element);
  for (int f = 0; f < element.count; ++f) {
    body.begin_item(element, f);
    for (size_t p = 0; p < element.properties.size(); ++p) {
      const Property &property = element.properties[p];
      if (p != corners) {
        skip_property(body, property);
        continue;
      }
      const int n = whole_number(body, body.value(property.count_type), MAX_COUNT, "corner count");
      if (n < 3)
        body.fail("has " + std::to_string(n) +
                  " corners; a face has 3 or more: correct it or export the mesh again");
      for (int k = 0; k < n; ++k)
        soup.corners.push_back(whole_number(body, body.value(property.type), num_points, "corner"));
    }
    body.end_item();
    soup.end_polygon();
  }
}

/// Corner -1 ends a strip and begins another.
void read_strips(const std::string &path, Body &body, const Element &element, int num_points,
                 PolygonSoup &soup)
{
  const size_t corners = corner_list(path, element);
  for (int i = 0; i < element.count; ++i) {
    body.begin_item(element, i);
    for (size_t p = 0; p < element.properties.size(); ++p) {
      const Property &property = element.properties[p];
      if (p != corners) {
        skip_property(body, property);
        continue;
      }
      const int n = whole_number(body, body.value(property.count_type), MAX_COUNT, "corner count");
      std::vector<int> strip;
      for (int k = 0; k < n; ++k) {
        const double v = body.value(property.type);
        if (v == -1.0) {
          soup.add_strip(strip);
          strip.clear();
        } else {
          strip.push_back(whole_number(body, v, num_points, "corner"));
        }
      }
      soup.add_strip(strip);
    }
    body.end_item();
  }
}

void skip_element(Body &body, const Element &element)
{
  if (element.properties.empty()) return;
  for (int i = 0; i < element.count; ++i) {
    body.begin_item(element, i);
    for (const Property &property : element.properties) skip_property(body, property);
    body.end_item();
  }
}

}    // namespace

/* ----------------------------------------------------------------------
   PLY [G. Turk, The PLY Polygon File Format, 1994], in text with each element on a line of its own
------------------------------------------------------------------------- */

PolygonSoup Membrane_NS::read_ply(const std::string &path, std::string_view content)
{
  const Header header = read_header(path, content);
  int num_points = 0;
  for (const Element &element : header.elements)
    if (element.name == "vertex") num_points = element.count;

  Body body(path, content, header);
  PolygonSoup soup;
  for (const Element &element : header.elements) {
    if (element.name == "vertex")
      read_vertices(path, body, element, soup);
    else if (element.name == "face")
      read_faces(path, body, element, num_points, soup);
    else if (element.name == "tristrips")
      read_strips(path, body, element, num_points, soup);
    else
      skip_element(body, element);
  }
  body.end_file();
  return soup;
}
