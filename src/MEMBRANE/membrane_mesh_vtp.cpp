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

#include "membrane_mesh_bytes.h"
#include "membrane_mesh_readers.h"
#include "membrane_mesh_text.h"

#include <cmath>
#include <cstdint>
#include <map>

using namespace Membrane_NS;

namespace {

constexpr const char *CURE =
    "; save it in ParaView with Data Mode Ascii, or Binary and Compressor Type None";

// === XML, as much of it as VTK writes

struct Tag {
  std::string name;    // with a slash in front at its end
  std::map<std::string, std::string> attributes;
  bool closed = false;    // <name/>
};

class Xml {
 public:
  Xml(const std::string &path, std::string_view content) : path_(path), content_(content) {}

  /// The next tag that is neither a comment nor a declaration; false at the end of the file.
  bool next(Tag &tag)
  {
    while (true) {
      const size_t start = content_.find('<', position_);
      if (start == std::string_view::npos) return false;
      position_ = start + 1;
      if (content_.substr(position_, 3) == "!--") {
        skip_past("-->");
        continue;
      }
      if (content_.substr(position_, 1) == "?" || content_.substr(position_, 1) == "!") {
        skip_past(">");
        continue;
      }
      read(tag);
      return true;
    }
  }

  /// What follows up to the next tag.
  std::string_view text() const
  {
    return content_.substr(position_, content_.find('<', position_) - position_);
  }

  [[noreturn]] void fail(const std::string &problem) const { mesh_file_error(path_, 0, problem); }

 private:
  const std::string &path_;
  std::string_view content_;
  size_t position_ = 0;
  static constexpr std::string_view BLANKS = " \t\r\n";

  void skip_past(std::string_view end)
  {
    const size_t at = content_.find(end, position_);
    if (at == std::string_view::npos) fail_truncated();
    position_ = at + end.size();
  }
  [[noreturn]] void fail_truncated() const
  {
    fail("the file ends within a tag: it is truncated; export it again");
  }
  std::string_view word(std::string_view ends)
  {
    const size_t end = content_.find_first_of(ends, position_);
    if (end == std::string_view::npos) fail_truncated();
    const std::string_view found = content_.substr(position_, end - position_);
    position_ = end;
    return found;
  }

  void read(Tag &tag)
  {
    tag = Tag();
    const bool is_end = content_.substr(position_, 1) == "/";
    if (is_end) ++position_;
    tag.name = (is_end ? "/" : "") + std::string(word(" \t\r\n/>"));
    while (true) {
      position_ = content_.find_first_not_of(BLANKS, position_);
      if (position_ == std::string_view::npos) {
        position_ = content_.size();
        fail_truncated();
      }
      const char c = content_[position_];
      if (c == '>') {
        ++position_;
        return;
      }
      if (c == '/') {
        tag.closed = true;
        ++position_;
        continue;
      }
      const std::string key(word("= \t\r\n/>"));
      if (content_[position_] != '=')
        fail("attribute " + quoted(key) + " has no value; export it again");
      ++position_;
      const char quote = position_ < content_.size() ? content_[position_] : ' ';
      if (quote != '"' && quote != '\'')
        fail("the value of attribute " + quoted(key) + " is not in quotes; export it again");
      ++position_;
      tag.attributes[key] = std::string(word(std::string_view(&quote, 1)));
      ++position_;
    }
  }
};

// === Arrays of numbers

/// Any number of encoded runs, each padded by itself, as VTK writes the length and then the data.
std::string decode_base64(const Xml &xml, std::string_view text)
{
  std::string bytes;
  uint32_t group = 0;
  int digits = 0, padding = 0;
  for (char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    int value = 0;
    if (c >= 'A' && c <= 'Z')
      value = c - 'A';
    else if (c >= 'a' && c <= 'z')
      value = c - 'a' + 26;
    else if (c >= '0' && c <= '9')
      value = c - '0' + 52;
    else if (c == '+' || c == '/')
      value = c == '+' ? 62 : 63;
    else if (c == '=')
      ++padding;
    else
      xml.fail("a binary array has the character " + quoted({&c, 1}) + "; export it again");
    group = group << 6 | static_cast<uint32_t>(value);
    if (++digits < 4) continue;
    for (int i = 0; i < 3 - padding; ++i) bytes += static_cast<char>(group >> (16 - 8 * i));
    group = 0;
    digits = padding = 0;
  }
  if (digits) xml.fail("a binary array is truncated; export it again");
  return bytes;
}

/// What the file says at its beginning of all its arrays.
struct Encoding {
  bool big_endian = false, long_header = false, compressed = false;
};

template <typename T> std::vector<double> numbers_of(std::string_view bytes, bool big_endian)
{
  std::vector<double> values(bytes.size() / sizeof(T));
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<double>(load<T>(&bytes[sizeof(T) * i], big_endian));
  return values;
}

std::vector<double> read_binary(const Xml &xml, const std::string &type, const Encoding &encoding)
{
  const std::string bytes = decode_base64(xml, xml.text());
  const size_t head = encoding.long_header ? 8 : 4;
  if (bytes.size() < head) xml.fail("a binary array has no length; export it again");
  const uint64_t size = encoding.long_header ? load<uint64_t>(bytes.data(), encoding.big_endian)
                                             : load<uint32_t>(bytes.data(), encoding.big_endian);
  if (size > bytes.size() - head)
    xml.fail("a binary array has " + std::to_string(bytes.size() - head) + " of " +
             std::to_string(size) + " bytes: it is truncated or compressed" + CURE);
  const std::string_view data = std::string_view(bytes).substr(head, size);
  const bool big = encoding.big_endian;
  if (type == "Float64") return numbers_of<double>(data, big);
  if (type == "Float32") return numbers_of<float>(data, big);
  if (type == "Int64") return numbers_of<int64_t>(data, big);
  if (type == "UInt64") return numbers_of<uint64_t>(data, big);
  if (type == "Int32") return numbers_of<int32_t>(data, big);
  if (type == "UInt32") return numbers_of<uint32_t>(data, big);
  if (type == "Int16") return numbers_of<int16_t>(data, big);
  if (type == "UInt16") return numbers_of<uint16_t>(data, big);
  if (type == "Int8") return numbers_of<int8_t>(data, big);
  if (type == "UInt8") return numbers_of<uint8_t>(data, big);
  xml.fail("an array has the unknown type " + quoted(type) + "; export it again");
}

std::vector<double> read_array(const std::string &path, const Xml &xml, const Tag &tag,
                               const Encoding &encoding)
{
  auto attribute = [&tag](const char *name) {
    const auto found = tag.attributes.find(name);
    return found == tag.attributes.end() ? std::string() : found->second;
  };
  const std::string format = attribute("format");
  if (format == "binary") {
    if (encoding.compressed) xml.fail(std::string("its arrays are compressed") + CURE);
    return read_binary(xml, attribute("type"), encoding);
  }
  if (format != "ascii") xml.fail("its arrays are in the format " + quoted(format) + CURE);
  std::vector<double> values;
  MeshText text(path, xml.text(), '\0');
  while (text.next_line())
    for (int i = 0; i < text.size(); ++i) {
      double value;
      if (!parse_number(text[i], value))
        xml.fail(quoted(text[i]) +
                 " in an array is not a number; correct it or export the mesh again");
      values.push_back(value);
    }
  return values;
}

// === A piece: points, and polygons and strips of them

int whole_number(const Xml &xml, double value, double limit, const char *what)
{
  if (!(value >= 0.0 && value < limit) || value != std::floor(value)) {
    std::string number;
    append_number(number, value);
    xml.fail(std::string(what) + " " + number + " is not an integer from 0 to below " +
             std::to_string(static_cast<long long>(limit)) +
             "; correct it or export the mesh again");
  }
  return static_cast<int>(value);
}

struct Cells {
  std::vector<double> connectivity, offsets;
};

struct Piece {
  std::vector<double> coordinates;
  Cells polygons, strips;
};

void add_cells(const Xml &xml, const Cells &cells, int first_point, int num_points, bool strips,
               PolygonSoup &soup)
{
  size_t at = 0;
  std::vector<int> corners;
  for (double offset : cells.offsets) {
    const size_t end =
        whole_number(xml, offset, static_cast<double>(cells.connectivity.size()) + 1.0,
                     "the end of a polygon in its list of corners");
    if (end < at + 3)
      xml.fail("a polygon has fewer than 3 corners; correct it or export the mesh again");
    corners.clear();
    for (; at < end; ++at)
      corners.push_back(first_point +
                        whole_number(xml, cells.connectivity[at], num_points, "corner"));
    if (strips) {
      soup.add_strip(corners);
    } else {
      soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
      soup.end_polygon();
    }
  }
  if (at != cells.connectivity.size())
    xml.fail("it lists more corners than its polygons have: it is truncated; export it again");
}

void add_piece(const Xml &xml, const Piece &piece, PolygonSoup &soup)
{
  if (piece.coordinates.size() % 3 != 0)
    xml.fail("the number of coordinates is not three times the number of points; export it again");
  const int first = static_cast<int>(soup.points.size());
  for (size_t i = 0; i < piece.coordinates.size(); i += 3) {
    soup.points.emplace_back(&piece.coordinates[i]);
    if (!soup.points.back().allFinite())
      xml.fail("a coordinate of point " + std::to_string(i / 3) +
               " is not finite; correct it or export the mesh again");
  }
  const int num_points = static_cast<int>(soup.points.size()) - first;
  add_cells(xml, piece.polygons, first, num_points, false, soup);
  add_cells(xml, piece.strips, first, num_points, true, soup);
}

}    // namespace

/* ----------------------------------------------------------------------
   VTK XML PolyData. Of each piece the arrays of points, and of polygons and strips, each in a
   section of that name; the sections with fields, vertices and lines are left out.
------------------------------------------------------------------------- */

PolygonSoup Membrane_NS::read_vtp(const std::string &path, std::string_view content)
{
  Xml xml(path, content);
  Tag tag;
  if (!xml.next(tag) || tag.name != "VTKFile")
    xml.fail("the tag VTKFile is missing at the beginning; is this a VTP file?");
  if (tag.attributes["type"] != "PolyData")
    xml.fail("it holds " + quoted(tag.attributes["type"]) +
             ", no PolyData; extract the surface in ParaView and save it as .vtp");
  Encoding encoding;
  encoding.big_endian = tag.attributes["byte_order"] == "BigEndian";
  encoding.long_header = tag.attributes["header_type"] == "UInt64";
  encoding.compressed = tag.attributes.count("compressor") > 0;

  PolygonSoup soup;
  Piece piece;
  std::string section;
  bool complete = false;
  while (!complete) {
    if (!xml.next(tag))
      xml.fail("the file ends before </VTKFile>: it is truncated; export it again");
    complete = tag.name == "/VTKFile";
    if (tag.name == "/Piece") {
      add_piece(xml, piece, soup);
      piece = Piece();
    } else if (tag.name == "Points" || tag.name == "Polys" || tag.name == "Strips") {
      section = tag.closed ? "" : tag.name;
    } else if (tag.name == "/" + section) {
      section.clear();
    } else if (tag.name == "DataArray" && !section.empty()) {
      const std::string name = tag.attributes["Name"];
      Cells &cells = section == "Polys" ? piece.polygons : piece.strips;
      if (section == "Points")
        piece.coordinates = read_array(path, xml, tag, encoding);
      else if (name == "connectivity")
        cells.connectivity = read_array(path, xml, tag, encoding);
      else if (name == "offsets")
        cells.offsets = read_array(path, xml, tag, encoding);
    }
  }
  return soup;
}
