// STL files: what is read of them, and what is refused.
#include "mechanism/read_stl.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <set>
#include <vector>

namespace clearloci::mechanism {
namespace {

using Triangle = std::array<std::array<float, 3>, 3>;

/// A tetrahedron, seen from outside.
std::vector<Triangle> tetrahedron() {
  const std::array<float, 3> o{0, 0, 0}, x{100, 0, 0}, y{0, 50.5F, 0}, z{0, 0, 0.1F};
  return {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
}

std::string binary(const std::vector<Triangle>& triangles, const std::string& head = "solid in name only") {
  std::string bytes = head;
  bytes.resize(80, ' ');
  const auto put = [&](const void* value, std::size_t size) { bytes.append(static_cast<const char*>(value), size); };
  const auto count = static_cast<std::uint32_t>(triangles.size());
  put(&count, 4);
  for (const Triangle& triangle : triangles) {
    bytes.append(12, '\0');
    for (const auto& corner : triangle) put(corner.data(), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string text(const std::vector<Triangle>& triangles) {
  std::string text = "solid a part with loop in its name\r\n";
  for (const Triangle& triangle : triangles) {
    text += "  facet normal 0 0 0\r\n    outer loop\r\n";
    for (const auto& corner : triangle) {
      text += "      vertex";
      for (const float value : corner) text += " " + std::to_string(value);
      text += "\r\n";
    }
    text += "    endloop\r\n  endfacet\r\n";
  }
  return text + "endsolid\r\n";
}

std::string complaint(const std::string& bytes) {
  try {
    parse_stl(bytes, "part.stl", 0.001);
  } catch (const core::InputError& error) {
    const std::string words = error.what();
    EXPECT_EQ(words.find('\n'), std::string::npos);
    return words;
  }
  return "none";
}

TEST(Stl, BinaryAndTextSayTheSame) {
  const core::TaskMesh one = parse_stl(binary(tetrahedron()), "part.stl", 0.001),
                       two = parse_stl(text(tetrahedron()), "part.stl", 0.001);
  ASSERT_EQ(one.corners.size(), 4U);
  EXPECT_EQ(one.triangles, two.triangles);
  ASSERT_EQ(one.triangles.size(), 4U);
  std::set<std::array<double, 3>> corners(one.corners.begin(), one.corners.end());
  EXPECT_TRUE(corners.count({0, 0.0505, 0}));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(one.corners[i][c], two.corners[i][c], 1e-10);
}

TEST(Stl, OpenSurfacesAreRefused) {
  auto triangles = tetrahedron();
  triangles.pop_back();
  EXPECT_NE(complaint(binary(triangles)).find("of 6 edges 3 have triangles on one side only"), std::string::npos)
      << complaint(binary(triangles));
  EXPECT_NE(complaint(text(triangles)).find("is not closed"), std::string::npos);
  auto turned = tetrahedron();
  std::swap(turned[0][1], turned[0][2]);
  EXPECT_NE(complaint(binary(turned)).find("is not closed"), std::string::npos);
}

TEST(Stl, TrianglesWithoutAreaAreLeftOut) {
  auto triangles = tetrahedron();
  const auto corner = triangles[0][0], other = triangles[0][1];
  triangles.push_back({corner, corner, other});
  EXPECT_EQ(parse_stl(binary(triangles), "part.stl", 1).triangles.size(), 4U);
}

TEST(Stl, OtherFilesAreRefusedInOneLine) {
  EXPECT_NE(complaint("").find("no triangles"), std::string::npos);
  EXPECT_NE(complaint("solid nothing\nendsolid\n").find("no triangles"), std::string::npos);
  EXPECT_NE(complaint("format: 1\nbox: {}\n").find("no STL file"), std::string::npos);
  EXPECT_NE(complaint("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex 1 0 0\n").find("no three numbers"),
            std::string::npos);
  EXPECT_NE(complaint("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e999\n").find("no three numbers"),
            std::string::npos);
  EXPECT_NE(complaint("solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n").find("2 corners"),
            std::string::npos);
  auto triangles = tetrahedron();
  triangles[0][0][0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(complaint(binary(triangles)).find("not finite"), std::string::npos);
  std::string cut = binary(tetrahedron());
  cut.pop_back();
  EXPECT_NE(complaint(cut), "none");
}

}  // namespace
}  // namespace clearloci::mechanism
