"""What stands in the page as it is: its frame, its style and its script, filled in and put together by `page.py`."""
