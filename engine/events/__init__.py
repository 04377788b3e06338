"""Events: every hand-over in the mind as frozen data, and how they are shown: one by one, or as a timeline.

In: a type, a time, data. Out: JSON, or printed lines. Knows of no stage of the mind.
"""

from casper.engine.events.event import TYPES as TYPES
from casper.engine.events.event import Event as Event
