"""Running minds: those for all partners in view, and a mind that follows the files of its domain.

In: world states, what the robot did, changed files. Out: events, each with the agent it is about.
"""

from casper.engine.live.partners import Partners as Partners
from casper.engine.live.renewal import Live as Live
from casper.engine.live.renewal import renewed as renewed
from casper.engine.live.reports import Message as Message
from casper.engine.live.reports import Report as Report
from casper.engine.live.reports import heard as heard
from casper.engine.live.reports import message_from_json as message_from_json
from casper.engine.live.segmenting import by_day as by_day
