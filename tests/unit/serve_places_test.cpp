// Places of connections: bounded in all and for each peer, and lost by who is slow.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/places.hpp"

namespace lekalo::server::serve_places_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct Connection {
  std::unique_ptr<Place> place;
  bool cut = false;
};

class PlacesTest : public ::testing::Test {
 protected:
  std::shared_ptr<Connection> connect(Places& places, const std::string& peer) {
    auto made = std::make_shared<Connection>();
    made->place = places.give(
        peer, [one = made.get()] { one->cut = true; }, now_);
    return made;
  }
  Places::Time now_{seconds(1000)};
};

TEST_F(PlacesTest, AreBoundedInAllAndForEachPeer) {
  Places places({5, 3, 5, 3, 100, 100});
  std::vector<std::shared_ptr<Connection>> all;
  for (int i = 0; i < 3; ++i) all.push_back(connect(places, "a"));
  EXPECT_EQ(connect(places, "a")->place, nullptr);  // the server works for all of them
  for (int i = 0; i < 2; ++i) all.push_back(connect(places, "b"));
  EXPECT_EQ(connect(places, "c")->place, nullptr);
  EXPECT_EQ(places.connections(), 5u);
  all.clear();
  EXPECT_EQ(places.connections(), 0u);
}

TEST_F(PlacesTest, GoToOthersFromWhoIsWaitedForLongest) {
  Places places({3, 2, 3, 2, 100, 100});
  const auto a = connect(places, "a"), b = connect(places, "b"), c = connect(places, "b");
  b->place->wait(now_, seconds(60));
  now_ += milliseconds(100);
  c->place->wait(now_, seconds(60));
  const auto fourth = connect(places, "b");  // the peer has two already, so one of its own goes
  EXPECT_TRUE(fourth->place);
  EXPECT_TRUE(b->cut);
  EXPECT_FALSE(a->cut || c->cut);
  a->place->wait(now_ - seconds(9), seconds(60));
  EXPECT_TRUE(connect(places, "c")->place);  // of the peer that has most, though another is slower
  EXPECT_TRUE(c->cut);
  EXPECT_FALSE(a->cut || fourth->cut);
}

TEST_F(PlacesTest, OfWhomTheServerWorksForAreNotLost) {
  Places places({2, 2, 2, 2, 100, 100});
  const auto a = connect(places, "a"), b = connect(places, "a");
  a->place->wait(now_, seconds(60));
  a->place->work();
  now_ += seconds(30);
  places.sweep(now_);
  EXPECT_EQ(connect(places, "c")->place, nullptr);
  EXPECT_FALSE(a->cut || b->cut);
}

TEST_F(PlacesTest, AreLostWhenTheTimeIsOverAndKeptByWhoMovesBytes) {
  Places places;
  const auto fast = connect(places, "a"), drop = connect(places, "a"), silent = connect(places, "a");
  for (const auto& one : {fast, drop, silent}) one->place->wait(now_, kPace);
  for (int i = 0; i < 60; ++i) {
    now_ += milliseconds(100);
    fast->place->moved(kPaceBytes / 40, now_);
    drop->place->moved(1, now_);
    places.sweep(now_);
  }
  EXPECT_FALSE(fast->cut);
  EXPECT_TRUE(drop->cut);
  EXPECT_TRUE(silent->cut);
  EXPECT_EQ(places.connections(), 1u);
}

TEST_F(PlacesTest, OfThoseThatStayAreFewerAndTheMostSilentGoes) {
  Places places({9, 9, 3, 2, 100, 100});
  const auto a = connect(places, "a"), b = connect(places, "a"), c = connect(places, "a"),
             d = connect(places, "b"), e = connect(places, "c");
  EXPECT_TRUE(a->place->stay(now_));
  EXPECT_TRUE(b->place->stay(now_ += seconds(1)));
  a->place->heard(now_ += seconds(1));
  EXPECT_TRUE(c->place->stay(now_));
  EXPECT_TRUE(b->cut);
  EXPECT_TRUE(d->place->stay(now_ - seconds(9)));
  EXPECT_TRUE(e->place->stay(now_));  // of the peer that has most, though another is more silent
  EXPECT_TRUE(a->cut || c->cut);
  EXPECT_FALSE(d->cut);
}

TEST_F(PlacesTest, HoldBoundedBytesAndWhoIsSlowGivesTheOwn) {
  Places places({9, 9, 9, 9, 100, 60});
  const auto a = connect(places, "a"), b = connect(places, "a"), c = connect(places, "c");
  EXPECT_TRUE(a->place->hold(1000, now_));  // alone
  EXPECT_FALSE(b->place->hold(1, now_));
  EXPECT_TRUE(a->place->hold(50, now_));
  EXPECT_TRUE(b->place->hold(10, now_));
  EXPECT_FALSE(b->place->hold(11, now_));
  EXPECT_EQ(places.bytes(), 60u);
  EXPECT_FALSE(c->place->hold(41, now_));
  a->place->wait(now_, seconds(60));
  now_ += seconds(2);
  EXPECT_TRUE(c->place->hold(41, now_));
  EXPECT_TRUE(a->cut);
  EXPECT_EQ(places.bytes(), 51u);
  EXPECT_FALSE(a->place->hold(1, now_));  // it has no place any more
  EXPECT_TRUE(b->place->hold(0, now_));
  b->place.reset();
  c->place.reset();
  EXPECT_EQ(places.bytes(), 0u);
}

}  // namespace
}  // namespace lekalo::server::serve_places_test
