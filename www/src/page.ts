// What script adds to a page of text; without it, all is there: links lead to the terms, and everything can be scrolled.
import './cards'
import './contents'
import './scrollers'
