"""Drawing of moving pictures: where things stand on the picture, and the formats GIF, mp4 and HTML."""
