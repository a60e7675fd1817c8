"""Thresholds: from where on a motion is called by a name. One table for all that is stated."""

import math

# speed
STANDING = 0.14  # [m/s] below which a vehicle stands
MOVING = 1.0  # [m/s] from which one that stood is under way again
CHANGED = 1.5  # [m/s] by which a speed has changed
BEGINNING = 0.4  # [m/s] likewise, of a change that is going on at the end of the record
WAVER = 0.15  # [m/s] of speed that do not end a stretch of slowing down
TREND_TIME = 1.0  # [s] over which a trend is judged
TREND = 0.4  # [m/s2] from which it is one
BRAKING = 0.8  # [m/s2] from which slowing down is braking
HARD = 3.0  # [m/s2] from which braking is hard

# way
TURNED = math.radians(50.0)  # change of heading that is a turn
BEGUN = math.radians(8.0)  # of it from which the turn has begun, and before which it is over
TURN_LENGTH = 45.0  # [m] within which a turn is made
ALONG = math.radians(10.0)  # difference of heading that still counts as the same way
SLANT = math.radians(30.0)  # difference of heading within a lane change at most
LANE_SHIFT = (2.2, 5.5)  # [m] sideways in one lane change
LANE_TIME = 6.0  # [s] that a lane change takes at most

# where others are
SAME_LANE = 2.0  # [m] sideways distance of centres below which a vehicle is on our line
SAME_WAY = math.radians(50.0)  # headings that differ by less go our way
OPPOSITE = math.radians(130.0)  # and by more come towards us, until they have passed
ROAD_WIDTH = 12.0  # [m] sideways within which those who pass are on the same road
NEAR = 15.0  # [m] between bodies within which a vehicle is near
CLOSE = 1.0  # [m] between bodies below which two moving vehicles nearly touch

# how two vehicles meet
FOLLOWING = 4.0  # [s] gap to the one ahead up to which it is followed ...
FOLLOWING_GAP = 12.0  # [m] ... or, at a crawl, the gap
FOLLOWED = 2.0  # [s] for which one follows at least
CUT_IN = 2.5  # [s] gap left by one who moves in, up to which he cuts in
CUT_IN_GAP = 15.0  # [m] ... or the gap
CROSSING = 40.0  # [m] ahead of us within which somebody crosses our way
PULLED_OUT = 60.0  # [m] ahead of us within which somebody pulls out
HELD_UP = 0.5  # share of the imagined drives from which a hold-up counts
AT_ONCE = 0.6  # [s] from a decision within which a hold-up begins that is going on
YIELDING = 8.0  # [s] of driving before a standstill that belong to giving way

# seeing
BROKEN = 0.5  # [s] without a sample after which a vehicle was not seen in between
STALE = 2.5  # [s] after the last decision up to which it still tells what is
BIG, SMALL = 6.5, 3.0  # [m] of length from which a vehicle is big, and below which it is small

# comfort
SMOOTHED = 0.6  # [s] over which jerk is taken
