#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows that check_coverage.py finds what it should, on small trees."""
import shutil
import tempfile
import sys
import unittest
from pathlib import Path

from check_coverage import check

HEADER = """
namespace armature::rt {

/// Tells what is new.
template <typename T>
class [[nodiscard]] BasicNews final : public Base {
 public:
  struct Item {
    /// @rt nonblocking
    int size() const { return size_; }
    int size_;
  };

  /// Adds one; see `Item`.
  /// @rt nonblocking, no allocation
  /// @thread the writer only
  template <typename U>
  void add(const U& item);
  /// May take its time.
  void print() const;
  /// @rt nonblocking
  bool operator()(int index) const;
};

/// @rt nonblocking
#if defined(__x86_64__)
inline long ticks() { return 0; }
#endif

/// Text in place.
/// @rt nonblocking
class Text {
};

}  // namespace armature::rt
"""


class CheckCoverage(unittest.TestCase):
    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        self.write("armature/rt/news.hpp", HEADER)

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def names(self, tested):
        return [name for _, name, is_tested in check(self.root) if is_tested == tested]

    def test_every_promise_is_found_under_its_name(self):
        self.assertEqual(self.names(tested=False),
                         ["Item::size", "News::add", "News::operator()", "rt::ticks", "Text"])

    def test_the_place_of_the_promise_is_told(self):
        self.assertEqual(next(check(self.root))[0], "armature/rt/news.hpp:9")

    def test_a_test_names_the_function_in_quotes(self):
        self.write("tests/realtime/news_test.cpp",
                   'expect_realtime("News::add", [&] { news.add(1); });  // rt::ticks, not in quotes')
        self.assertEqual(self.names(tested=True), ["News::add"])
        self.assertIn("rt::ticks", self.names(tested=False))

    def test_a_longer_name_is_another_function(self):
        self.write("tests/realtime/news_test.cpp", 'expect_realtime("News::add_all", [] {});')
        self.assertIn("News::add", self.names(tested=False))

    def test_tests_elsewhere_do_not_count(self):
        self.write("tests/stress/news_test.cpp", 'expect_realtime("News::add", [] {});')
        self.assertIn("News::add", self.names(tested=False))

    def test_headers_that_nobody_sees_promise_nothing(self):
        self.write("armature/rt/internal/old.hpp", "/// @rt nonblocking\nvoid hidden();\n")
        self.write("armature/testing/fake.hpp", "/// @rt nonblocking\nvoid fake();\n")
        names = self.names(tested=False)
        self.assertNotIn("rt::hidden", names)
        self.assertNotIn("testing::fake", names)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
