"""Thresholds from which a motion has a name, in one table for all statements."""

import math

# speed
STANDING = 0.14  # [m/s] below which a vehicle stands
MOVING = 1.0  # [m/s] from which a vehicle that stood is under way again
CHANGED = 1.5  # [m/s] minimum change of a speed that counts
BEGINNING = 0.4  # [m/s] minimum for a change that is going on at the end of the record
WAVER = 0.15  # [m/s] variation of speed that is no change of it
PAUSE = 2.0  # [s] of a speed that does not change, which end a change of speed
REBOUND = 0.3  # [m/s] by which a speed may turn without ending a change of speed
TREND_TIME = 1.0  # [s] over which a trend is judged
TREND = 0.4  # [m/s2] minimum acceleration of a trend
BRAKING = 0.8  # [m/s2] from which slowing down is braking
HARD = 3.0  # [m/s2] from which braking is hard

# way
TURNED = math.radians(50.0)  # minimum change of heading of a turn
BEGUN = math.radians(8.0)  # change of heading from which a turn has begun
TURN_LENGTH = 45.0  # [m] maximum length of a turn
ALONG = math.radians(10.0)  # difference of heading that still counts as the same way
SLANT = math.radians(30.0)  # maximum difference of headings within a lane change
LANE_SHIFT = (2.2, 5.5)  # [m] minimum and maximum shift sideways in one lane change
LANE_TIME = 6.0  # [s] maximum duration of a lane change

# where others are
SAME_LANE = 2.0  # [m] maximum offset sideways of the centre of a vehicle on our line
SAME_WAY = math.radians(50.0)  # vehicles whose headings differ by less go our way
OPPOSITE = math.radians(130.0)  # those that differ by more go the opposite way
ROAD_WIDTH = 12.0  # [m] maximum offset sideways of a vehicle that passes on the same road
NEAR = 15.0  # [m] between bodies within which a vehicle is near
CLOSE = 1.0  # [m] between bodies below which two moving vehicles nearly touch

# how two vehicles meet
FOLLOWING = 4.0  # [s] maximum gap to the vehicle ahead that is followed ...
FOLLOWING_GAP = 12.0  # [m] ... or, at a crawl, the gap
FOLLOWED = 2.0  # [s] minimum duration of following
CUT_IN = 2.5  # [s] maximum gap left by a vehicle that cuts in ...
CUT_IN_GAP = 15.0  # [m] ... or the gap
CROSSING = 40.0  # [m] ahead of us within which somebody crosses our way
PULLED_OUT = 60.0  # [m] ahead of us within which somebody pulls out
HELD_UP = 0.5  # minimum share of the rollouts for a hold-up to count
AT_ONCE = 0.6  # [s] after a decision in which a hold-up begins that is going on
YIELDING = 8.0  # [s] maximum time from giving way to a standstill that belongs to it

# seeing
BROKEN = 0.5  # [s] between samples from which a vehicle was not seen in between
STALE = 2.5  # [s] maximum age of a decision that still shows the present
BIG, SMALL = 6.5, 3.0  # [m] lengths from which a vehicle is big, and below which it is small

# comfort
SMOOTHED = 0.6  # [s] over which jerk is averaged
