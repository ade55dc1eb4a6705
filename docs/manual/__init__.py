"""The manual: pages of docs/, what the program gives to them, and the site that is made of both."""
