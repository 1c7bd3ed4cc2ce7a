#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <thread>

#include "base/scheduler.h"
#include "support/rounds.h"
#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using samples::Entries;
using samples::Kind;
using samples::Tree;
using ByteVector = std::vector<std::byte>;

// The parts of an image that were read.
struct Reads {
  std::size_t calls = 0, inner_bytes = 0, leaf_bytes = 0;
};

// A stored image, to which changes are written as a store would.
struct StoredImage {
  ByteVector header, inner, leaves;

  std::size_t write(const ImageParts& parts) {
    header.assign(parts.header.begin(), parts.header.end());
    return write(parts.inner, parts.inner_bytes, inner) + write(parts.leaves, parts.leaves_bytes, leaves);
  }
  /// The tree, which reads its nodes as they are needed, each array in blocks of so many nodes. What is read is listed.
  algebra3d::Result<Tree> open(std::size_t nodes_at_once, Reads* reads = nullptr) const {
    return Tree::from_image(header, reader_of(inner, kInnerBytes, nodes_at_once, reads, false),
                            reader_of(leaves, leaf_bytes(8), nodes_at_once, reads, true));
  }
  Tree lazy_tree(std::size_t nodes_at_once, Reads* reads = nullptr) const {
    return std::move(open(nodes_at_once, reads)).value();
  }
  /// The tree with all nodes in memory.
  Tree tree() const {
    const Tree lazy = lazy_tree(16);
    return lazy;  // NOLINT(performance-no-automatic-move): a copy has all
  }

 private:
  static NodeReader reader_of(const ByteVector& array, std::size_t node_bytes, std::size_t nodes_at_once, Reads* reads,
                              bool are_leaves) {
    // The array may have more nodes later on.
    const auto read = [=, &array, end = array.size()](std::size_t begin, std::span<std::byte> bytes) {
      EXPECT_EQ(begin % (node_bytes * nodes_at_once), 0U);
      EXPECT_LE(begin + bytes.size(), end);
      EXPECT_TRUE(bytes.size() % (node_bytes * nodes_at_once) == 0 || begin + bytes.size() == end);
      std::memcpy(bytes.data(), array.data() + begin, bytes.size());
      if (reads == nullptr) return;
      ++reads->calls;
      (are_leaves ? reads->leaf_bytes : reads->inner_bytes) += bytes.size();
    };
    return {array.size(), nodes_at_once, read};
  }

  static std::size_t write(const std::vector<ImagePart>& parts, std::size_t size, ByteVector& array) {
    array.resize(size);
    std::size_t written = 0;
    for (const ImagePart& part : parts) {
      std::memcpy(array.data() + part.begin, part.bytes.data(), part.bytes.size());
      written += part.bytes.size();
    }
    return written;
  }
};

StoredImage stored(const Tree& tree) {
  StoredImage result;
  result.write(tree.image());
  return result;
}

std::vector<std::uint64_t> order_of(const Tree& tree, const Box3& window) {
  std::vector<std::uint64_t> ids;
  for (const std::uint64_t id : tree.window(window)) ids.push_back(id);
  return ids;
}

void expect_same(const Tree& found, const Tree& expected, Kind kind) {
  ASSERT_EQ(audit(found), std::vector<std::string>{});
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_EQ(found.bounds(), expected.bounds());
  ASSERT_EQ(order_of(found, found.bounds()), order_of(expected, found.bounds()));
  std::mt19937_64 random(1);
  for (int round = 0; round < 20; ++round) {
    const Box3 box = samples::random_box(random, kind);
    ASSERT_EQ(order_of(found, box), order_of(expected, box));
    auto nearest = found.nearest(box, 5), expected_nearest = expected.nearest(box, 5);
    for (int i = 0; i < 5; ++i) ASSERT_EQ(nearest.next(), expected_nearest.next());
  }
}

TEST(Image, gives_the_tree_again) {
  for (const Kind kind : samples::kKinds) {
    for (const std::size_t count : {0, 1, 16, 17, 300, 5000}) {
      const Tree tree = Tree::bulk_load(samples::random_entries(count, kind, 1));
      const StoredImage image = stored(tree);
      expect_same(image.tree(), tree, kind);
      for (const std::size_t at_once : {1, 4, 7, 10'000}) expect_same(image.lazy_tree(at_once), tree, kind);
    }
  }
}

TEST(Image, payloads_of_32_bits) {
  std::vector<Entry<std::uint32_t>> entries;
  for (const auto& entry : samples::random_entries(1000, Kind::clustered, 1))
    entries.push_back({entry.box, static_cast<std::uint32_t>(entry.payload)});
  const auto tree = RTree<std::uint32_t>::bulk_load(entries);
  const ImageParts parts = tree.image();
  const auto reader_of = [](std::span<const std::byte> array) {
    const auto read = [array](std::size_t begin, std::span<std::byte> bytes) {
      std::memcpy(bytes.data(), array.data() + begin, bytes.size());
    };
    return NodeReader{array.size(), 3, read};
  };
  const NodeReader inner = reader_of(parts.inner[0].bytes), leaves = reader_of(parts.leaves[0].bytes);
  const auto again = RTree<std::uint32_t>::from_image(parts.header, inner, leaves);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->entries(), tree.entries());
  const auto other = Tree::from_image(parts.header, inner, leaves);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().text(), "image of an R-tree: payloads of 4 bytes and nodes of 16 slots");
}

// The same bytes in whatever order they are written down here: what the format says of one entry.
TEST(Image, of_one_entry_is_as_documented) {
  Tree tree;
  tree.insert({{1, 2, 3}, {4, 5, 6}}, 7);
  const ImageParts parts = tree.image();
  const auto number = [](std::span<const std::byte> bytes, std::size_t at, std::size_t width) {
    std::uint64_t result = 0;
    for (std::size_t i = width; i-- > 0;) result = result << 8 | std::to_integer<std::uint64_t>(bytes[at + i]);
    return result;
  };
  const std::span<const std::byte> header = parts.header, leaf = parts.leaves.at(0).bytes;
  EXPECT_EQ(number(header, 0, 8), 0x0a1a0a0d54334189U);
  EXPECT_EQ(number(header, 8, 4), kImageVersion);
  EXPECT_EQ(number(header, 12, 4), 0x01020304U);
  EXPECT_EQ(number(header, 16, 4), 8U);
  EXPECT_EQ(number(header, 20, 4), 16U);
  EXPECT_EQ(number(header, 24, 8), 1U);
  EXPECT_EQ(number(header, 32, 4), 0U);
  EXPECT_EQ(number(header, 36, 4), 1U);
  ASSERT_EQ(leaf.size(), leaf_bytes(8));
  EXPECT_EQ(number(header, 96, 4), 0xffffffffU);
  EXPECT_EQ(number(header, 100, 4), 0xffffffffU);
  EXPECT_EQ(number(leaf, 4, 4), 0x7fffffffU);
  EXPECT_EQ(number(leaf, 384, 8), 7U);
  // 1.0 is 0x3ff0000000000000: key and remainder give it back.
  const std::uint64_t base = number(header, 48, 8), shift = number(header, 56, 4);
  const auto key = static_cast<std::int32_t>(number(leaf, 0, 4));
  EXPECT_EQ((base + static_cast<std::uint64_t>(key)) << shift | number(leaf, 512, 4), 0x3ff0000000000000U);
}

TEST(Image, nodes_are_read_when_they_are_needed) {
  const Entries entries = samples::random_entries(20'000, Kind::points, 2);
  const Tree tree = Tree::bulk_load(entries);
  const StoredImage image = stored(tree);
  Reads reads;
  const Tree lazy = image.lazy_tree(4, &reads);
  EXPECT_EQ(lazy.size(), entries.size());
  EXPECT_EQ(reads.calls, 0U);
  EXPECT_EQ(samples::window_ids(lazy, entries[5].box), samples::scan(entries, entries[5].box));
  EXPECT_LE(reads.leaf_bytes, image.leaves.size() / 20);
  EXPECT_LE(reads.inner_bytes, image.inner.size() / 4);
  const Tree copy = lazy;
  EXPECT_EQ(reads.leaf_bytes, image.leaves.size());
  EXPECT_EQ(reads.inner_bytes, image.inner.size());
  EXPECT_EQ(copy.entries(), tree.entries());
}

// 200,000 entries are 12,500 leaves in 3,125 blocks.
TEST(Image, a_tree_that_is_read_as_a_whole_is_read_in_runs) {
  const Tree tree = Tree::bulk_load(samples::random_entries(200'000, Kind::points, 2));
  const StoredImage image = stored(tree);
  Reads reads;
  const Tree lazy = image.lazy_tree(4, &reads);
  EXPECT_EQ(order_of(lazy, lazy.bounds()), order_of(tree, tree.bounds()));
  EXPECT_EQ(reads.leaf_bytes, image.leaves.size());
  EXPECT_LE(reads.calls, 400U);
}

// Two changes of one box in a tree of 200,000 read few nodes; those that are not read stay as they are stored.
TEST(Image, a_change_reads_few_nodes) {
  Entries entries = samples::random_entries(200'000, Kind::points, 2);
  StoredImage image;
  {
    Tree tree = Tree::bulk_load(entries, Filling::room_for_changes);
    image.write(tree.take_changes());
  }
  Reads reads;
  Tree lazy = image.lazy_tree(4, &reads);
  for (const std::size_t i : {17, 150'000}) {
    ASSERT_TRUE(lazy.erase(entries[i].box, entries[i].payload));
    entries[i].box = {entries[i].box.min, entries[i].box.max + Vec3{0.25, 0, 0}};
    ASSERT_TRUE(lazy.insert(entries[i].box, entries[i].payload));
  }
  EXPECT_LE(reads.calls, 60U);
  EXPECT_LE(reads.leaf_bytes, image.leaves.size() / 40);
  image.write(lazy.take_changes());
  const Tree again = image.tree();
  EXPECT_EQ(audit(again), std::vector<std::string>{});
  for (const std::size_t i : {17, 150'000, 3})
    EXPECT_EQ(samples::window_ids(again, entries[i].box), samples::scan(entries, entries[i].box));
}

// Free nodes of an image are used again, and one that is in use is not.
TEST(Image, free_nodes_are_linked) {
  const Entries entries = samples::random_entries(3000, Kind::uniform, 3);
  Tree tree = Tree::bulk_load(entries);
  for (std::size_t i = 0; i < 2500; ++i) ASSERT_TRUE(tree.erase(entries[i].box, entries[i].payload));
  StoredImage image = stored(tree);
  ASSERT_NE(tree.storage().free_leaf, kNoNode);
  ASSERT_NE(tree.storage().free_inner, kNoNode);
  Tree lazy = image.lazy_tree(4);
  for (std::size_t i = 0; i < 2500; ++i) ASSERT_TRUE(lazy.insert(entries[i].box, entries[i].payload));
  EXPECT_EQ(audit(lazy), std::vector<std::string>{});
  EXPECT_LE(lazy.storage().leaves.size(), tree.storage().leaves.size() * 2);
  EXPECT_EQ(lazy.storage().free_leaf, kNoNode);
  const NodeIndex used = tree.storage().inner[tree.storage().root].reference[0];
  std::memcpy(image.header.data() + 96, &used, sizeof(used));
  Tree wrong = image.lazy_tree(4);
  const auto insert_all = [&] {
    for (const auto& entry : entries) wrong.insert(entry.box, entry.payload);
  };
  EXPECT_THROW(insert_all(), DamagedImage);
}

// Threads of their own, so that ThreadSanitizer sees all that synchronises them.
TEST(Image, nodes_are_read_by_concurrent_windows) {
  const Entries entries = samples::random_entries(20'000, Kind::points, 3);
  const StoredImage image = stored(Tree::bulk_load(entries));
  const Tree lazy = image.lazy_tree(3);
  std::atomic<std::size_t> wrong = 0;
  const auto ask = [&](std::size_t first) {
    for (std::size_t i = first; i < entries.size(); i += 997)
      wrong += samples::window_ids(lazy, entries[i].box) != samples::scan(entries, entries[i].box);
  };
  std::thread beside(ask, 1), reading_all([&] { wrong += lazy.entries().size() != entries.size(); });
  ask(0);
  beside.join();
  reading_all.join();
  EXPECT_EQ(wrong, 0U);
}

TEST(Image, nodes_are_read_by_many_threads) {
  const Tree tree = Tree::bulk_load(samples::random_entries(20'000, Kind::uniform, 3));
  const StoredImage image = stored(tree);
  for (const int threads : {1, 4})
    algebra3d::with_threads(threads, [&] {
      EXPECT_EQ(samples::sorted_pairs(image.lazy_tree(3).self_join()), samples::sorted_pairs(tree.self_join()));
    });
}

// A store that writes only what is said to have changed has the tree after each operation; the trees that come out of
// it go on in the same way.
TEST(Image, changes_are_all_that_has_to_be_written) {
  for (const Kind kind : {Kind::uniform, Kind::grid, Kind::outlier}) {
    Entries alive = samples::random_entries(700, kind, 4);
    Tree tree = Tree::bulk_load(alive);
    StoredImage image;
    image.write(tree.take_changes());
    std::mt19937_64 random(5);
    for (int step = 0; step < 3000; ++step) {
      if (alive.empty() || random() % 10 < (step < 1000 ? 6U : 2U)) {
        alive.push_back({samples::random_box(random, kind), static_cast<std::uint64_t>(1000 + step)});
        ASSERT_TRUE(tree.insert(alive.back().box, alive.back().payload));
      } else {
        std::swap(alive[random() % alive.size()], alive.back());
        ASSERT_TRUE(tree.erase(alive.back().box, alive.back().payload));
        alive.pop_back();
      }
      image.write(tree.take_changes());
      if (step % 50 == 0) tree = step % 100 == 0 ? image.tree() : image.lazy_tree(4);
      if (step % 50 == 25) expect_same(image.tree(), tree, kind);
    }
  }
}

// One entry is moved a little, time after time, in a tree that was loaded for changes.
TEST(Image, an_update_changes_few_pages) {
  const Entries entries = samples::random_entries(200'000, Kind::points, 6);
  Tree tree = Tree::bulk_load(entries, Filling::room_for_changes);
  tree.take_changes();
  std::size_t most = 0;
  for (std::size_t i = 0; i < entries.size(); i += 100) {
    tree.erase(entries[i].box, entries[i].payload);
    tree.insert({entries[i].box.min + Vec3{1e-3, 0, 0}, entries[i].box.max + Vec3{1e-3, 0, 0}}, entries[i].payload);
    const ImageParts changes = tree.take_changes();
    std::size_t pages = 1;  // of the header
    const auto count = [&](const std::vector<ImagePart>& parts, std::size_t node_bytes, std::size_t nodes_on_page) {
      std::vector<bool> seen;
      for (const ImagePart& part : parts) {
        for (std::size_t at = part.begin; at < part.begin + part.bytes.size(); at += node_bytes) {
          const std::size_t page = at / node_bytes / nodes_on_page;
          if (page >= seen.size()) seen.resize(page + 1);
          pages += !seen[page];
          seen[page] = true;
        }
      }
    };
    count(changes.inner, kInnerBytes, 9);
    count(changes.leaves, leaf_bytes(8), 4);
    most = std::max(most, pages);
  }
  EXPECT_LE(most, 10U);
}

TEST(Image, other_versions_and_byte_orders_are_refused) {
  const StoredImage sound = stored(Tree::bulk_load(samples::random_entries(100, Kind::uniform, 7)));
  for (const std::size_t place : {8, 12}) {
    StoredImage image = sound;
    image.header[place] ^= std::byte{1};
    const auto tree = image.open(1);
    ASSERT_FALSE(tree);
    EXPECT_EQ(tree.error().code, algebra3d::ErrorCode::database_version);
  }
}

// Whatever is done with a tree of damaged bytes, it ends.
void use(Tree& tree, std::mt19937_64& random) {
  std::size_t found = 0;
  for (int round = 0; round < 4; ++round) {
    const Box3 box = samples::random_box(random, Kind::uniform);
    for (const std::uint64_t id : tree.window(box)) found += id % 2;
    auto nearest = tree.nearest(box, round % 2 == 0 ? 10 : 100);
    while (const auto next = nearest.next()) found += next->payload % 2;
    tree.insert(box, 1);
    tree.erase(box, round % 2 == 0 ? 1 : 2);
  }
  for (const auto& entry : tree.entries()) tree.erase(entry.box, entry.payload);
  found += samples::sorted_pairs(tree.self_join()).size();
  EXPECT_LT(found, SIZE_MAX);
}

TEST(Image, damaged_bytes_do_no_harm) {
  const Tree tree = Tree::bulk_load(samples::random_entries(400, Kind::uniform, 8));
  const StoredImage sound = stored(tree);
  std::mt19937_64 random(9);
  std::size_t refused = 0, used = 0;
  for (int round = 0; round < algebra3d::rounds(750); ++round) {
    StoredImage image = sound;
    ByteVector* const arrays[] = {&image.header, &image.inner, &image.leaves};
    for (std::size_t times = random() % 3 + 1; times > 0; --times) {
      ByteVector& array = *arrays[random() % 3];
      const std::size_t place = random() % array.size();
      const std::byte values[] = {std::byte{0}, std::byte{0xff}, std::byte{0x80}, array[random() % array.size()]};
      array[place] = values[random() % 4];
    }
    if (random() % 10 == 0) image.leaves.resize(random() % image.leaves.size());
    for (const bool has_all : {false, true}) {
      try {
        auto opened = image.open(2);
        if (opened && has_all) static_cast<void>(audit(*opened));
        if (opened) use(*opened, random);
        ++(opened ? used : refused);
      } catch (const DamagedImage&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, algebra3d::rounds(75U));
  EXPECT_GT(used, algebra3d::rounds(75U));
}

}  // namespace
}  // namespace rtree
