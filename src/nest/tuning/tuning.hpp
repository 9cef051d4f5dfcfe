#pragma once

#include <cstddef>
#include <cstdint>

namespace lekalo::nest {

/// How long an attempt goes on: it gets a strike after so many passes without 2 % less overlap, and so many
/// strikes end it.
struct Patience {
  int passes, strikes;
};

/// Every constant of the search that was chosen by trying, in the order of the steps of docs/design/nest.md
/// and docs/design/nest-sheets.md. Each says its unit, what it decides and what breaks when it changes; the
/// trials are in docs/measurements/nest.md. All of them change layouts, none of them can make a layout
/// invalid. Bounds that follow from a derivation stand beside it, not here.
///
/// Shares of a size are shares of the square root of an area: of a part's hull, or of the middling part's.
namespace tuning {

// ---- Tables of depths (nest.md, step 1) ----------------------------------------------------------------

/// Share of a part's size. The search sees an outline that is simplified outwards by at most this much.
/// Larger: parts keep more distance than they have to. Smaller: tables of detailed parts take seconds to
/// make.
inline constexpr double kSimplify = 0.0005;
/// Corners. Outlines with no more than these are not simplified. Table time grows with the square of it.
inline constexpr std::size_t kEnoughCorners = 48;
/// Corners, and the largest share of a part's size. An outline that has more of them even when it is
/// simplified is simplified further, by twice the share each time. More corners: seconds for a table, minutes
/// for one of some thousand. A larger share: a visible gap around detailed parts.
inline constexpr std::size_t kMostCorners = 200;
inline constexpr double kSimplifyMost = 0.008;
/// mm. As kSimplify, for defects, whose own size says little about what matters.
inline constexpr double kSimplifyDefect = 0.1;
/// Cells of the raster of one table. More: tables take longer and fall out of the cache (1,024, 2,048 and
/// 4,096 cells gave 25, 22 and 17 million places in the same time). Fewer: depths deep inside get rough.
inline constexpr std::size_t kRasterCells = 2048;
/// Cells along a side of the raster of depths for one cell of the raster of common areas. Smaller: four
/// times the memory for half of it. Larger: a thin overlap falls between two nodes.
inline constexpr double kAreaCell = 2;
/// How many times the cells of a pair of parts a table of part and stock gets. Less: a sheet's border and
/// defects are too rough, since such a table covers the whole stock.
inline constexpr std::size_t kStockCells = 4;
/// Tables. An order that may need more of them than this gets rasters of a quarter of the cells, because
/// each serves few looks. Without it orders of many parts at free angles spend their time making tables.
inline constexpr double kManyTables = 4000;
/// Angles of given placements that become forms beside the usual ones. Every pair of angles may need a
/// table; with fewer, given pieces are placed anew more often.
inline constexpr int kMostGivenAngles = 64;

// ---- Separation (nest.md, step 2) ----------------------------------------------------------------------

/// Share of the middling part's size. What any overlap costs at least. 0: many small overlaps are cheaper
/// than one, up to a point less on shirts and swim. 0.03: as much less on shirts.
inline constexpr double kLeastValue = 0.003;
/// Millimetres of depth that a millimetre of the root of the common area counts as. 0: the depth of a long
/// thin overlap says too little. 1: small overlaps look as bad as deep ones; half a point less on both.
inline constexpr double kAreaShare = 0.3;
/// Candidate places of a move near the item, and anywhere where there is no grid of costs. Fewer: puzzles
/// do not close (jakobs1 with 5 and 20: 85.3 % instead of 89.0 %). More: fewer moves in the same time.
inline constexpr int kFocused = 10, kAnywhere = 40;
/// Candidate places of a piece that is put near a point. Fewer: the room made for it is missed.
inline constexpr int kNear = 400;
/// Tries to put a piece anywhere on the open stock in some form. When all of them miss, it stays where it
/// was.
inline constexpr int kPlaceTries = 1000;
/// Items. From more on neighbours are looked up in cells: below, a pass over all boxes is quicker.
inline constexpr std::size_t kManyItems = 512;
/// Cells of one bin for looking up neighbours. A strip of open length has cells up to here, and what lies
/// beyond shares the last ones. More take memory; fewer put more boxes into each.
inline constexpr double kMostCells = 100'000;
/// Shares of the item's narrow side. The first step of a descent, where the first descent ends, and where
/// the second one does. A larger end leaves pieces short of the contact that push_out() needs.
inline constexpr double kFirstStep = 0.25, kCoarseStep = 0.02, kFineStep = 0.001;
/// Factors of a step of the descent after a gain and after a vain one.
inline constexpr double kStepGrowth = 1.1, kStepShrink = 0.5;
/// Rounds of pushing an item out along depths, and the round from which one without a gain is the last.
inline constexpr int kPushRounds = 12, kLeastPushRounds = 6;
/// Factors of the weights of pairs after a pass: of all, and of those still in conflict, by depth. Decay of
/// 0.99 loses 0.2 points on shirts, growth of 1.1 to 1.3 a point: the search stays in one heap.
inline constexpr double kDecay = 0.95, kLeastGrowth = 1.2, kMostGrowth = 2.0;

// ---- The grid of costs (nest.md, step 3) ---------------------------------------------------------------

/// Shares of the middling part's size: the pitch of the grid, and the one where rasters of that would be
/// too large. Coarser: the hollow that is sought lies between two nodes.
inline constexpr double kPitch = 1.0 / 16, kCoarsePitch = 1.0 / 8;
/// Rows and nodes of the window that is looked at where the stock is larger.
inline constexpr std::uint32_t kMostRows = 256, kMostWindow = 20'000;
/// Forms of the item that one move looks at. More: fewer moves in the same time. Fewer: the angle that fits
/// is looked at too seldom.
inline constexpr std::uint32_t kFormsOnGrid = 4;
/// Nodes that are added up in the time of one place, and nodes for one node of a raster that is made. They
/// keep the work of a run in step with its time; a wrong value gives a strand more time than the other.
inline constexpr std::uint64_t kNodesAsPlace = 2000, kMadeNode = 128;
/// Nodes of sums that are kept from move to move: of one form on one bin, and of all (4 bytes each, a
/// strand).
inline constexpr std::uint32_t kMostKept = 80'000, kMostKeptInAll = 8'000'000;
/// Nodes of what all obstacles of a bin cost together, by form (4 bytes each, a strand). Orders that need
/// more get one raster for every obstacle.
inline constexpr double kMostMerged = 8e6;
/// Nodes of all rasters of pairs of forms (4 bytes each, a strand), and forms. Orders that need more do
/// without a grid and look at kAnywhere random places instead.
inline constexpr double kMostRasterNodes = 16e6;
inline constexpr std::size_t kMostRasterForms = 4000;

// ---- Relaxing (nest.md, step 4) ------------------------------------------------------------------------

/// Share of the middling part's size. Pairs whose boxes are nearer than this (and the widest gap) are
/// relaxed. Smaller: items that were far apart meet unseen, and the result is not free. Larger: more pairs
/// a round.
inline constexpr double kCloseMargin = 0.2;
/// Rounds without 1 % less overlap that end relaxing. Fewer: slow but sure endings are cut off.
inline constexpr int kStalledRounds = 20;
/// Pairs that are looked at in the time of one place, as kNodesAsPlace.
inline constexpr std::uint64_t kPairsAsPlace = 8;

// ---- Moves on strips (nest.md, steps 4 to 9) -----------------------------------------------------------

/// Rounds of relaxing in the middle of an attempt; its beginning has twice as many. Fewer: chains of
/// items are not pushed through to the end.
inline constexpr int kRelaxRounds = 100;
/// Passes. Besides at every new least overlap an attempt is relaxed so often while it is near the least.
/// Relaxing at new least overlaps alone loses 0.3 points on swim.
inline constexpr int kRelaxEvery = 10;
/// Factor of the least overlap that is "near" it.
inline constexpr double kRelaxBelow = 1.5;
/// Share of the length. A state that is shorter than the best by no more than this is no gain.
inline constexpr double kGain = 1e-6;
/// Shares of the length by which a valid state is pushed together: the first, halved where it fails, and
/// the last. Without this and without relaxing beyond the length asked for: 0.2 to 0.4 points less on swim.
inline constexpr double kCompactFrom = 0.004, kCompactTo = 1e-5;
/// insert: the patience of an attempt, and how many failed states are remembered. More patience: fewer
/// items are tried.
inline constexpr Patience kInsertPatience = {100, 2};
inline constexpr std::size_t kInsertPool = 8;
/// explore: shares of the length that are asked for first and in the end. Beginning with 0.1 % loses half a
/// point on shirts.
inline constexpr double kFirstShorter = 0.02, kExploreShorter = 0.001;
/// explore: the patience of an attempt while shares are large, and after that. Less: 0.2 points on swim.
inline constexpr Patience kHastyPatience = {50, 1}, kExplorePatience = {200, 3};
/// explore: attempts in vain at the smallest share before compressing. 12: 0.2 points less on swim. 4: up
/// to half a point less on shirts.
inline constexpr std::size_t kFailuresToCompress = 6;
/// Share of all hulls. Parts that make up so much of them, largest first, count as large and change places.
inline constexpr double kLargeShare = 0.75;
/// Standard deviation, as a share of the pool, of the rank of the failed state that is gone on from.
/// Smaller: the same state again and again. Larger: states that are far from valid.
inline constexpr double kPoolSpread = 0.25;
/// Tries to find a second large item that is of another part.
inline constexpr int kOtherPartTries = 50;
/// compress: shares of the length, the first, the last, and the factor after each failure. A larger first
/// one fails every time; a smaller last one spends time on micrometres.
inline constexpr double kCompressFrom = 0.0005, kCompressTo = 0.00001, kCompressDecay = 0.7;
inline constexpr Patience kCompressPatience = {100, 3};
/// lattice: lengths that are tried, its unit, half of it, a quarter of it, one after the other. With the
/// unit alone fu stays at 32; with a half it reaches 31.8.
inline constexpr int kLatticeSizes = 3;
/// lattice: work without a gain until it is left. More takes time from strips that need no lattice.
inline constexpr std::uint64_t kLatticeWork = 1'500'000;
/// lattice: places on a bin for it to be used at all. With fewer there is nothing to choose from; with more
/// a move, which looks at all of them, is too slow.
inline constexpr double kFewestLatticePlaces = 100, kMostLatticePlaces = 20'000;

// ---- The exact engine (nest.md, steps 11 and 12) -------------------------------------------------------

/// Millimetres to the right that one millimetre down is worth. Larger: low places are preferred to left
/// ones, and a strip gets longer.
inline constexpr double kDown = 0.05;
/// Shares of the item's narrow side: the first and the last step of sliding left and down. A larger last
/// one leaves gaps that only the search closes.
inline constexpr double kFirstSlide = 0.5, kLastSlide = 1e-4;
/// Places tried of one piece on one stock: all pieces share a number, within limits.
struct Tries {
  std::size_t in_all, least, most;
};
/// Those of a first layout. 200 to 400 places left 75 of the 280 pieces of Test7 out where 10,000 leave 60.
inline constexpr Tries kBuildTries = {2'000'000, 200, 10'000};
/// Those of the sketch before it, which is made where that would take a second and more. More: a large order
/// shows nothing for seconds. Fewer: what it shows lies loosely, until the first layout comes.
inline constexpr Tries kSketchTries = {40'000, 10, 200};
/// The most items that are searched: a strand has a weight of 4 bytes for every pair, 1.6 GB of these. With
/// more there is a first layout alone.
inline constexpr std::size_t kMostToSearch = 20'000;
/// Items, and corners of all of them together, from which on there is a sketch.
inline constexpr std::size_t kManyToBuild = 30, kManyCorners = 5000;
/// Places tried of a piece on empty stock, to say why it is not placed. Fewer: "too large" of what is not.
inline constexpr std::size_t kReasonTries = 4000;

/// Rounds of shifting pieces apart on the grid before one is taken out. Fewer: pieces are taken out that one
/// more shift would have saved. Each round is an exact check of the whole layout.
inline constexpr int kSettleRounds = 60;

// ---- Moves on sheets (nest-sheets.md, steps 1 to 6) ----------------------------------------------------

/// Share of the material of the stock. Fuller stock is not tried. Smaller: sheets that could be saved are
/// not. 1: turns are spent on what no layout reaches.
inline constexpr double kFullest = 0.97;
/// fill: turns that gain nothing, after which the other moves get theirs too. 0: missing pieces wait; many:
/// the rest never gets better where one piece fits nowhere.
inline constexpr int kVainFills = 3;
/// fill: the pieces thrown in at first are one in so many of those that lie nowhere. All at once: 205 of
/// the 280 pieces of Test7 instead of 260.
inline constexpr std::size_t kFirstBatch = 8;
/// fill, reduce: attempts in vain that end a turn. Fewer give up too early, more keep other moves waiting.
inline constexpr int kFailuresToFill = 100, kFailuresToReduce = 30;
/// fill, reduce: failures in a row before pieces change places in every second attempt.
inline constexpr int kFailuresToExchange = 2;
inline constexpr Patience kFillPatience = {60, 2};
/// fill, reduce: places tried of each kind of piece on each bin after a rearrangement. None at all: 265 of
/// the pieces of Test7 where 275 were placed.
inline constexpr std::size_t kRefillTries = 4000;
/// rooms: made before a rearrangement. Seconds until all pieces of Test7 lie, seeds 1 to 3: 2 rooms 21, 41
/// and more than 60; 30 rooms 17, 33, 16; 100 rooms 26, 19, 52. None: 272 to 275 pieces after 40 s.
inline constexpr std::size_t kRooms = 30;
/// rooms: slides of single pieces before a rearrangement, so that with thousands of pieces rooms take no
/// longer than it does.
inline constexpr std::size_t kSlides = 16'000;
/// rooms: times that all pieces slide away from the same point, and rounds of relaxing the new piece.
inline constexpr int kSweeps = 2, kRoomRelaxRounds = 200;
/// rooms: shares of the item's narrow side, the first and the last step of a slide.
inline constexpr double kFirstRoomSlide = 0.5, kLastRoomSlide = 1e-3;
/// rooms: a step that gets no further than this share of itself, as the border is in the way, is none.
inline constexpr double kLeastSlideGain = 0.1;
/// Plans made to find kits that are worth more, and the share of the stock that a plan may take beyond what
/// is in use. More room gives plans that never fit.
inline constexpr int kPlans = 8;
inline constexpr double kMoreRoom = 0.1;
/// reduce: one piece in so many may lie nowhere for rooms to be worth their time. Always: the second sheet
/// of stool_x10 is never saved.
inline constexpr std::size_t kFewMissing = 8;
/// reduce: turns that go by rank alone or come whenever they are due; after those the rank is blurred by
/// this share, and turns come at every second, fourth, ... round, up to a power of two of kRarestReduction.
inline constexpr int kFirstReductions = 2, kRarestReduction = 6;
inline constexpr double kRankNoise = 0.3;
/// box: shares of a box's area by which the next one is smaller: first, last, most, and the factor after a
/// gain. A larger last one leaves what a puzzle would close.
inline constexpr double kFirstSmaller = 0.05, kLastSmaller = 0.001, kMostSmaller = 0.1, kSmallerGrowth = 1.2;
/// box: a kick (a box of any proportion) begins with so much more area than the best, and is given up where
/// it is still so much larger once shares are below kKickPatience.
inline constexpr double kKickRoom = 0.12, kKickEnd = 0.04, kKickPatience = 0.02;
/// box: attempts in vain before the share is halved.
inline constexpr int kFailuresToBox = 3;
/// box: the patience of an attempt, and the one where shares are below kFineBox.
inline constexpr Patience kBoxPatience = {40, 2}, kFineBoxPatience = {80, 2};
inline constexpr double kFineBox = 0.01;
/// Attempts in a row that left nothing to be separated, after which a strand is done.
inline constexpr int kVainAttempts = 1000;

// ---- Strands (nest.md, step 10) ------------------------------------------------------------------------

/// Strands of a run. Their number is part of the result: threads only carry them out.
inline constexpr std::size_t kStrands = 2;
/// Work of a strand between two merges. Longer: a stop loses more, and improvements are shown later.
inline constexpr std::uint64_t kSegment = 200'000;
/// Merges without a gain of its own after which a strand goes on from the best.
inline constexpr int kMergesAlone = 20;
/// Work of a first layout before which it is not left unfinished, whoever wants to stop.
inline constexpr std::uint64_t kFirstWork = 1'000'000;

}  // namespace tuning
}  // namespace lekalo::nest
