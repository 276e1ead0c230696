// The table of finished designs: what is read back after it was cut anywhere.
#include "studies/design_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "core/errors.hpp"
#include "tests/report/scratch_folder.hpp"

namespace clearloci {
namespace {

core::StudyDesign design(std::uint64_t index) {
  core::StudyDesign design;
  design.index = index;
  design.status = index % 2 == 0 ? core::StudyDesign::Status::feasible : core::StudyDesign::Status::infeasible;
  design.figures = {0.1 * static_cast<double>(index), std::nan("")};
  if (index % 2 == 1) {
    design.reason = "contact lost in A1, B1";
    design.at = core::Point2{1.0 / 3, -0.25};
  }
  return design;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(DesignTable, AnyBeginningOfItIsReadAsItsWholeLines) {
  const report::fixture::ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "designs.table";
  {
    DesignTable table(path, "0123456789abcdef", 2, false);
    for (std::uint64_t i = 0; i < 4; ++i) table.append(table_line(design(i)));
  }
  const std::string whole = bytes_of(path);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    write(path, whole.substr(0, size));
    const auto lines =
        static_cast<std::size_t>(std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size), '\n'));
    std::vector<core::StudyDesign> designs;
    {
      DesignTable table(path, "0123456789abcdef", 2, true);
      designs = table.take();
      table.append(table_line(design(9)));
    }
    ASSERT_EQ(designs.size(), lines == 0 ? 0 : lines - 1) << size;
    for (std::size_t i = 0; i < designs.size(); ++i) EXPECT_EQ(table_line(designs[i]), table_line(design(i)));
    DesignTable again(path, "0123456789abcdef", 2, true);
    EXPECT_EQ(again.take().size(), designs.size() + 1) << "what is appended after a cut is read";
  }
}

TEST(DesignTable, ADamagedLineEndsWhatIsRead) {
  const report::fixture::ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "designs.table";
  {
    DesignTable table(path, "h", 2, false);
    for (std::uint64_t i = 0; i < 3; ++i) table.append(table_line(design(i)));
  }
  std::string bytes = bytes_of(path);
  bytes[bytes.find("contact") + 2] = 'x';
  write(path, bytes);
  DesignTable table(path, "h", 2, true);
  EXPECT_EQ(table.take().size(), 1U);
}

TEST(DesignTable, OfAnotherStudyIsRefused) {
  const report::fixture::ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "designs.table";
  { DesignTable table(path, "one", 2, false); }
  EXPECT_THROW(DesignTable(path, "two", 2, true), core::InputError);
  EXPECT_NO_THROW(DesignTable(path, "two", 2, false));
}

TEST(DesignTable, IsWrittenByOneRunAtATime) {
  const report::fixture::ScratchFolder folder;
  const DesignTable first(folder.path() / "designs.table", "one", 2, false);
  EXPECT_THROW(DesignTable(folder.path() / "designs.table", "one", 2, true), core::InputError);
}

}  // namespace
}  // namespace clearloci
